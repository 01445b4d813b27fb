#include "study/evaluate/reference_bytes.h"

#include "study/record/bytes.h"

// The members of the engine's records that a reference run consists of.
namespace linkstudy {
namespace {

// An indexed vector as the list that it is.
template <class Index, class T>
std::vector<T>& list_of(IndexedVector<Index, T>& indexed) {
  return indexed;
}
template <class Index, class T>
const std::vector<T>& list_of(const IndexedVector<Index, T>& indexed) {
  return indexed;
}

}  // namespace

void visit_members(auto& archive, Like<Channel> auto& channel) {
  archive(channel.name, channel.unit);
  archive.template as<std::uint32_t>(channel.quantity);
  archive.template as<std::int64_t>(channel.index);
  archive.template as<std::int64_t>(channel.component);
  int body = channel.body.value();
  archive.template as<std::int64_t>(body);
  if constexpr (requires { channel.body = BodyIndex(body); }) channel.body = BodyIndex(body);
}

void visit_members(auto& archive, Like<Sampling> auto& sampling) {
  archive.template as<std::int64_t>(sampling.begin);
  archive.template as<std::int64_t>(sampling.end);
  archive.template as<std::int64_t>(sampling.stride);
}

void visit_members(auto& archive, Like<Series> auto& series) {
  archive(series.channels, series.sampling, series.values);
}

void visit_members(auto& archive, Like<State<double>> auto& state) {
  archive(state.t, state.supplied, state.dissipated, list_of(state.q), list_of(state.v),
          list_of(state.z));
}

void visit_members(auto& archive, Like<StepGrid> auto& grid) {
  archive.template as<std::int64_t>(grid.count);
  archive(grid.h);
}

void visit_members(auto& archive, Like<TimeWindow> auto& window) {
  archive(window.first, window.last);
}

// Records without cycles end before them.
void visit_members(auto& archive, Like<ReferenceRecord> auto& record) {
  archive(record.grid, record.match, record.traces, record.joints, record.poses, record.responses);
  if constexpr (requires { archive.at_end(); }) {
    if (!archive.at_end()) archive(record.cycles);
  } else {
    if (!record.cycles.empty()) archive(record.cycles);
  }
}

std::string encode_reference(const ReferenceRecord& record) {
  return to_bytes(record);
}

ReferenceRecord decode_reference(std::string_view bytes) {
  return from_bytes<ReferenceRecord>(bytes);
}

}  // namespace linkstudy
