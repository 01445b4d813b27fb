#include "study/record/evaluation_bytes.h"

#include <stdexcept>

namespace linkstudy {
namespace {

enum ValueTag : std::uint8_t { kWord = 0, kNumber = 1 };

void put_value(ByteWriter& out, const Value& value) {
  if (const double* number = std::get_if<double>(&value)) {
    out.put_u8(kNumber);
    out.put_f64(*number);
  } else {
    out.put_u8(kWord);
    out.put_text(std::get<std::string>(value));
  }
}

Value get_value(ByteReader& in) {
  if (in.get_u8() != kWord) return in.get_f64();
  return in.get_text();
}

}  // namespace

void put_numbers(ByteWriter& out, const std::vector<double>& numbers) {
  out.put_u64(numbers.size());
  for (const double number : numbers) out.put_f64(number);
}

std::vector<double> get_numbers(ByteReader& in) {
  std::vector<double> numbers(in.get_count(sizeof(double)));
  for (double& number : numbers) number = in.get_f64();
  return numbers;
}

void put_point(ByteWriter& out, const Point& point) {
  out.put_u64(point.id);
  out.put_u64(point.values.size());
  for (const Value& value : point.values) put_value(out, value);
}

Point get_point(ByteReader& in) {
  Point point;
  point.id = in.get_u64();
  point.values.resize(in.get_count(1));
  for (Value& value : point.values) value = get_value(in);
  return point;
}

void put_cause(ByteWriter& out, Cause cause) {
  out.put_u8(static_cast<std::uint8_t>(cause));
}

Cause get_cause(ByteReader& in) {
  const std::uint8_t number = in.get_u8();
  if (number >= kWords<Cause>.size()) throw std::out_of_range("record holds an unknown cause");
  return static_cast<Cause>(number);
}

void put_traces(ByteWriter& out, const std::vector<Trace>& traces) {
  out.put_u64(traces.size());
  for (const Trace& trace : traces) {
    out.put_text(trace.name);
    out.put_text(trace.unit);
    put_numbers(out, trace.values);
  }
}

std::vector<Trace> get_traces(ByteReader& in) {
  std::vector<Trace> traces(in.get_count(1));
  for (Trace& trace : traces) {
    trace.name = in.get_text();
    trace.unit = in.get_text();
    trace.values = get_numbers(in);
  }
  return traces;
}

}  // namespace linkstudy
