#include "study/evaluate/case_result.h"

#include <stdexcept>

#include "study/record/bytes.h"

namespace linkstudy {
namespace {

enum ValueTag : std::uint8_t { kNumber, kWord };

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
  if (in.get_u8() == kNumber) return in.get_f64();
  return in.get_text();
}

void put_numbers(ByteWriter& out, const std::vector<double>& numbers) {
  out.put_u64(numbers.size());
  for (const double number : numbers) out.put_f64(number);
}

std::vector<double> get_numbers(ByteReader& in) {
  std::vector<double> numbers(in.get_count(8));
  for (double& number : numbers) number = in.get_f64();
  return numbers;
}

void put_trace(ByteWriter& out, const Trace& trace) {
  out.put_text(trace.name);
  out.put_text(trace.unit);
  put_numbers(out, trace.values);
}

Trace get_trace(ByteReader& in) {
  Trace trace;
  trace.name = in.get_text();
  trace.unit = in.get_text();
  trace.values = get_numbers(in);
  return trace;
}

Cause get_cause(ByteReader& in) {
  const std::uint8_t number = in.get_u8();
  if (number >= kCauseNames.size()) throw std::out_of_range("unknown cause in a result");
  return static_cast<Cause>(number);
}

void put_point(ByteWriter& out, const Point& point) {
  out.put_u64(point.id);
  out.put_u64(point.values.size());
  for (const Value& value : point.values) put_value(out, value);
}

Point get_point(ByteReader& in) {
  Point point;
  point.id = in.get_u64();
  const std::size_t count = in.get_count(1);
  for (std::size_t i = 0; i < count; ++i) point.values.push_back(get_value(in));
  return point;
}

void put_result(ByteWriter& out, const CaseResult& result) {
  out.put_u8(static_cast<std::uint8_t>(result.status));
  out.put_text(result.message);
  put_numbers(out, result.responses);
  out.put_u64(result.traces.size());
  for (const CaseTraces& set : result.traces) {
    out.put_text(set.load_case);
    out.put_u64(set.traces.size());
    for (const Trace& trace : set.traces) put_trace(out, trace);
  }
  out.put_u32(result.attempts);
  out.put_text(result.host);
}

CaseResult get_result(ByteReader& in) {
  CaseResult result;
  result.status = get_cause(in);
  result.message = in.get_text();
  result.responses = get_numbers(in);
  const std::size_t sets = in.get_count(1);
  for (std::size_t i = 0; i < sets; ++i) {
    CaseTraces set{in.get_text(), {}};
    const std::size_t count = in.get_count(1);
    for (std::size_t k = 0; k < count; ++k) set.traces.push_back(get_trace(in));
    result.traces.push_back(std::move(set));
  }
  result.attempts = in.get_u32();
  result.host = in.get_text();
  return result;
}

}  // namespace

std::string encode_points(std::span<const Point> points) {
  ByteWriter out;
  out.put_u64(points.size());
  for (const Point& point : points) put_point(out, point);
  return out.bytes();
}

std::vector<Point> decode_points(std::string_view bytes) {
  ByteReader in(bytes);
  std::vector<Point> points(in.get_count(1));
  for (Point& point : points) point = get_point(in);
  return points;
}

std::string encode_results(std::span<const CaseResult> results) {
  ByteWriter out;
  out.put_u64(results.size());
  for (const CaseResult& result : results) put_result(out, result);
  return out.bytes();
}

std::vector<CaseResult> decode_results(std::string_view bytes) {
  ByteReader in(bytes);
  std::vector<CaseResult> results(in.get_count(1));
  for (CaseResult& result : results) result = get_result(in);
  return results;
}

}  // namespace linkstudy
