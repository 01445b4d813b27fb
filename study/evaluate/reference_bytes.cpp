#include "study/evaluate/reference_bytes.h"

#include <stdexcept>

#include "study/record/evaluation_bytes.h"

namespace linkstudy {
namespace {

void put_channel(ByteWriter& out, const Channel& channel) {
  out.put_text(channel.name);
  out.put_text(channel.unit);
  out.put_u32(static_cast<std::uint32_t>(channel.quantity));
  for (const int number : {channel.index, channel.component, channel.body}) out.put_i64(number);
}

Channel get_channel(ByteReader& in) {
  Channel channel;
  channel.name = in.get_text();
  channel.unit = in.get_text();
  channel.quantity = static_cast<Quantity>(in.get_u32());
  for (int* number : {&channel.index, &channel.component, &channel.body}) {
    *number = static_cast<int>(in.get_i64());
  }
  return channel;
}

void put_series(ByteWriter& out, const Series& series) {
  out.put_u64(series.channels.size());
  for (const Channel& channel : series.channels) put_channel(out, channel);
  for (const long step : {series.sampling.begin, series.sampling.end, series.sampling.stride}) {
    out.put_i64(step);
  }
  put_numbers(out, series.values);
}

Series get_series(ByteReader& in) {
  Series series;
  series.channels.resize(in.get_count(1));
  for (Channel& channel : series.channels) channel = get_channel(in);
  for (long* step : {&series.sampling.begin, &series.sampling.end, &series.sampling.stride}) {
    *step = static_cast<long>(in.get_i64());
  }
  series.values = get_numbers(in);
  return series;
}

void put_state(ByteWriter& out, const State<double>& state) {
  for (const double number : {state.t, state.supplied, state.dissipated}) out.put_f64(number);
  for (const auto* numbers : {&state.q, &state.v, &state.z}) put_numbers(out, *numbers);
}

State<double> get_state(ByteReader& in) {
  State<double> state;
  for (double* number : {&state.t, &state.supplied, &state.dissipated}) *number = in.get_f64();
  for (auto* numbers : {&state.q, &state.v, &state.z}) *numbers = get_numbers(in);
  return state;
}

}  // namespace

std::string encode_reference(const ReferenceRecord& record) {
  ByteWriter out;
  out.put_i64(record.grid.count);
  out.put_f64(record.grid.h);
  out.put_u64(record.match.size());
  for (const Series& series : record.match) put_series(out, series);
  put_traces(out, record.traces);
  out.put_u64(record.joints.size());
  for (const std::string& joint : record.joints) out.put_text(joint);
  out.put_u64(record.poses.size());
  for (const State<double>& pose : record.poses) put_state(out, pose);
  return out.bytes();
}

ReferenceRecord decode_reference(std::string_view bytes) {
  ByteReader in(bytes);
  ReferenceRecord record;
  record.grid.count = static_cast<long>(in.get_i64());
  record.grid.h = in.get_f64();
  record.match.resize(in.get_count(1));
  for (Series& series : record.match) series = get_series(in);
  record.traces = get_traces(in);
  record.joints.resize(in.get_count(1));
  for (std::string& joint : record.joints) joint = in.get_text();
  record.poses.resize(in.get_count(1));
  for (State<double>& pose : record.poses) pose = get_state(in);
  if (!in.at_end()) throw std::out_of_range("a reference run with something behind it");
  return record;
}

}  // namespace linkstudy
