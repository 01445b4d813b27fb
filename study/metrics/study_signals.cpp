#include "study/metrics/study_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/simulation/channel_kinds.h"
#include "core/topology/nearest_name.h"

namespace linkstudy {
namespace {

enum class Groups {
  vectors,    // "closure.S.force": components of one quantity, which share a norm
  everything  // "closure.S"
};

std::vector<Channel> find_signal(const std::vector<Channel>& channels, const std::string& signal,
                                 const char* where, const Location& at, Diagnostics& diagnostics,
                                 Groups groups = Groups::vectors) {
  std::vector<Channel> found = groups == Groups::vectors ? find_channels(channels, signal)
                                                         : find_channel_group(channels, signal);
  if (!found.empty()) return found;
  const std::vector<Channel> under = find_channel_group(channels, signal);
  if (!under.empty()) {
    diagnostics.add(at, fmt::format("the signal '{}' is a group of several quantities", signal),
                    fmt::format("choose one: {}", fmt::join(signal_names(under), ", ")));
    return {};
  }
  std::vector<std::string> names = signal_names(channels);
  for (const Channel& channel : channels) names.push_back(channel.name);
  diagnostics.add(at, fmt::format("there is no signal '{}' in {}", signal, where),
                  fmt::format("nearest: {}", fmt::join(nearest_names(signal, names, 3), ", ")));
  return {};
}

std::vector<Channel> find_angle(const std::vector<Channel>& channels,
                                const std::optional<CycleInput>& cycle, const char* where,
                                Diagnostics& diagnostics) {
  if (!cycle) return {};
  std::vector<Channel> found = find_signal(channels, cycle->of, where, cycle->at, diagnostics);
  const bool is_angle =
      found.size() == 1 && found.front().quantity == Quantity::q && found.front().unit == "rad";
  if (found.empty() || is_angle) return found;
  diagnostics.add(cycle->at, fmt::format("cycle: '{}' is not the angle of a joint", cycle->of),
                  "name the angle of a joint that turns through, such as joint.crank.q");
  return {};
}

std::vector<Channel> find_place(const std::vector<Channel>& channels,
                                const std::optional<PlaceInput>& place, Diagnostics& diagnostics) {
  if (!place || place->channel.empty()) return {};
  std::vector<Channel> found =
      find_signal(channels, place->channel, "the model", place->at, diagnostics);
  if (found.size() <= 1) return found;
  diagnostics.add(place->at,
                  fmt::format("where: '{}' has {} components", place->channel, found.size()),
                  fmt::format("name one, such as {}", found.front().name));
  return {};
}

void add_once(std::vector<Channel>& all, const std::vector<Channel>& more) {
  for (const Channel& channel : more) {
    const bool known =
        std::ranges::any_of(all, [&](const Channel& other) { return other.name == channel.name; });
    if (!known && channel.quantity != Quantity::time) all.push_back(channel);
  }
}

std::vector<std::vector<Channel>> find_gaps(const std::vector<Channel>& channels) {
  std::vector<std::vector<Channel>> gaps;
  for (const Channel& channel : channels) {
    if (channel.quantity != Quantity::closure_gap) continue;
    if (channel.component == 0) gaps.emplace_back();
    gaps.back().push_back(channel);
  }
  return gaps;
}

}  // namespace

bool same_channel(const Channel& a, const Channel& b) {
  const auto key = [](const Channel& c) {
    return std::tie(c.name, c.unit, c.quantity, c.index, c.component, c.body);
  };
  return key(a) == key(b);
}

bool same_channels(const std::vector<Channel>& a, const std::vector<Channel>& b) {
  return std::ranges::equal(a, b, same_channel);
}

StudySignals find_case_signals(const StudyInput& input, const std::vector<Channel>& channels,
                               Diagnostics& diagnostics) {
  StudySignals signals;
  signals.gaps = find_gaps(channels);
  for (const MatchInput& match : input.match) {
    signals.match.push_back(
        find_signal(channels, match.signal, "the model", match.at, diagnostics));
  }
  for (const ResponseInput& response : input.response) {
    signals.response.push_back(
        find_signal(channels, response.signal, "the model", response.at, diagnostics));
    signals.response_cycle.push_back(
        find_angle(channels, response.cycle, "the model", diagnostics));
    signals.response_place.push_back(find_place(channels, response.where, diagnostics));
  }
  for (const TraceInput& trace : input.trace) {
    add_once(signals.trace, find_signal(channels, trace.signal, "the model", trace.at, diagnostics,
                                        Groups::everything));
  }
  return signals;
}

StudySignals find_reference_signals(const StudyInput& input, const std::vector<Channel>& channels,
                                    Diagnostics& diagnostics) {
  StudySignals signals;
  for (const MatchInput& match : input.match) {
    signals.match.push_back(find_signal(channels, match.reference_signal, "the reference model",
                                        match.reference_at, diagnostics));
    add_once(signals.trace, signals.match.back());
    signals.match_cycle.push_back(
        find_angle(channels, match.cycle, "the reference model", diagnostics));
  }
  for (const ResponseInput& response : input.response) {
    Diagnostics of_the_case;  // what the reference lacks it does not answer
    signals.response.push_back(find_channels(channels, response.signal));
    signals.response_place.push_back(find_place(channels, response.where, of_the_case));
    signals.response_cycle.push_back(
        find_angle(channels, response.cycle, "the reference model", of_the_case));
    if (!of_the_case.empty()) signals.response.back().clear();
  }
  for (const TraceInput& trace : input.trace) {
    add_once(signals.trace, find_channel_group(channels, trace.signal));
  }
  return signals;
}

void check_signals(const StudyInput& input, const StudySignals& cases,
                   const StudySignals& reference, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < input.match.size(); ++i) {
    const MatchInput& match = input.match[i];
    if (cases.match[i].empty() || reference.match[i].empty()) continue;
    const std::size_t own = cases.match[i].size();
    const std::size_t other = reference.match[i].size();
    if (own == other) continue;
    diagnostics.add(match.reference_at,
                    fmt::format("'{}' has {} components and '{}' of the reference has {}",
                                match.signal, own, match.reference_signal, other),
                    "compare groups with groups and single channels with single channels");
  }
}

}  // namespace linkstudy
