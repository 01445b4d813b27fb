#include "study/metrics/measured_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/simulation/channel_kinds.h"
#include "core/topology/nearest_name.h"
#include "study/config/validate.h"
#include "study/metrics/invalid_point.h"

namespace linkstudy {
namespace {

constexpr double kOnStep = 1e-9;      // of a step
constexpr double kOffsetShare = 0.1;  // of the duration of the data

const Channel* find_one(const MeasuredChannel& measured, const std::vector<Channel>& channels,
                        Diagnostics& diagnostics) {
  const auto found = std::ranges::find(channels, measured.channel, &Channel::name);
  if (found != channels.end()) return &*found;
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  const std::vector<Channel> under = find_channel_group(channels, measured.channel);
  if (under.empty()) {
    diagnostics.add(
        measured.at, fmt::format("there is no channel '{}' in the model", measured.channel),
        fmt::format("nearest: {}", fmt::join(nearest_names(measured.channel, names, 3), ", ")));
  } else {
    diagnostics.add(measured.at, fmt::format("'{}' has several channels", measured.channel),
                    fmt::format("give each its own column: {}, ...", under.front().name));
  }
  return nullptr;
}

// The sigma that names a channel most exactly.
const SigmaInput* find_sigma(const MeasuredInput& input, const std::string& channel) {
  const SigmaInput* best = nullptr;
  for (const SigmaInput& one : input.sigma) {
    const bool is_meant = is_in_group(channel, one.signal);
    if (is_meant && (best == nullptr || one.signal.size() > best->signal.size())) best = &one;
  }
  return best;
}

void read_sigma(const MeasuredInput& input, MeasuredSignal& signal, Diagnostics& diagnostics) {
  if (input.weight) signal.sigma = 1.0 / *input.weight;
  const SigmaInput* written = find_sigma(input, signal.channel);
  if (written == nullptr) return;
  KeyRow row{.unit = signal.unit, .range = kPositive};
  Tree value = written->value;
  if (!validate_number(value, row, fmt::format("sigma of {}", signal.channel), diagnostics)) return;
  signal.sigma = value.as_number();
  signal.has_sigma = true;
}

// Without a window all; of results all but their start, where an unloaded spring never matches.
bool counts(const MeasuredInput& input, const MeasuredData& data, double time) {
  if (!input.window) return !input.results || time > data.times.front();
  return input.window->first <= time && time <= input.window->last;
}

}  // namespace

bool fits_unit(const MeasuredChannel& measured, const Channel& channel, Diagnostics& diagnostics) {
  const std::optional<Unit> own = parse_unit(channel.unit);
  if (!measured.unit || !own || measured.unit->dimensions == own->dimensions) return true;
  const std::string hint = explain_angle(*measured.unit, *own);
  diagnostics.add(measured.at,
                  fmt::format("'{}' is in {}, and its column in {}", channel.name, channel.unit,
                              dimension_text(measured.unit->dimensions)),
                  hint.empty() ? "give the column a unit of that kind" : hint);
  return false;
}

std::size_t MeasuredSet::sample_count() const {
  std::size_t count = 0;
  for (const MeasuredSignal& one : signals) count += one.times.size();
  return count;
}

double MeasuredSet::first() const {
  double first = std::numeric_limits<double>::infinity();
  for (const MeasuredSignal& one : signals) first = std::min(first, one.times.front());
  return first;
}

double MeasuredSet::last() const {
  double last = -std::numeric_limits<double>::infinity();
  for (const MeasuredSignal& one : signals) last = std::max(last, one.times.back());
  return last;
}

MeasuredSet make_measured_set(const MeasuredInput& input, const MeasuredData& data,
                              const std::vector<Channel>& channels, Diagnostics& diagnostics) {
  MeasuredSet set;
  set.offset = input.time_offset;
  for (const MeasuredChannel& measured : data.channels) {
    const Channel* channel = find_one(measured, channels, diagnostics);
    if (channel == nullptr || !fits_unit(measured, *channel, diagnostics)) continue;
    MeasuredSignal signal{channel->name, channel->unit, 1.0, false, {}, {}, measured.at};
    read_sigma(input, signal, diagnostics);
    for (std::size_t i = 0; i < data.times.size(); ++i) {
      if (std::isnan(measured.values[i]) || !counts(input, data, data.times[i])) continue;
      signal.times.push_back(data.times[i]);
      signal.values.push_back(measured.values[i]);
    }
    if (signal.times.empty()) {
      diagnostics.add(measured.at, fmt::format("'{}' has no sample in the window", channel->name),
                      "widen the window, or leave the column out");
      continue;
    }
    set.signals.push_back(std::move(signal));
  }
  return set;
}

MeasuredData to_measured_data(const MeasuredInput& input, const std::vector<Trace>& traces) {
  MeasuredData data;
  data.times = traces.front().values;
  const std::size_t skipped = input.window ? 0 : 1;
  data.times.erase(data.times.begin(), data.times.begin() + static_cast<std::ptrdiff_t>(skipped));
  for (const Trace& trace : traces) {
    const bool is_asked = std::ranges::any_of(
        input.signals, [&](const TraceInput& one) { return is_in_group(trace.name, one.signal); });
    if (!is_asked) continue;
    MeasuredChannel channel{trace.name, {}, input.signals.front().at, trace.values};
    channel.values.erase(channel.values.begin(),
                         channel.values.begin() + static_cast<std::ptrdiff_t>(skipped));
    data.channels.push_back(std::move(channel));
  }
  return data;
}

OffsetRange offset_range(const MeasuredSet& set, double end_time) {
  const double most = kOffsetShare * (set.last() - set.first());
  return {std::max(-most, -set.first()), std::min(most, end_time - set.last())};
}

void check_instants(const MeasuredInput& input, const MeasuredSet& set, double end_time,
                    Diagnostics& diagnostics) {
  if (set.signals.empty()) return;
  if (input.fits_offset) {
    const OffsetRange range = offset_range(set, end_time);
    if (range.low < range.high) return;
    diagnostics.add(input.offset_at, "the run leaves no room to shift the data in time",
                    "give a window that ends before the run does");
    return;
  }
  const double first = set.first() + input.time_offset;
  const double last = set.last() + input.time_offset;
  const double slack = kOnStep * end_time;
  if (first >= -slack && last <= end_time + slack) return;
  diagnostics.add(input.window ? input.window->at : input.file_at,
                  fmt::format("the data reach from {:.9g} s to {:.9g} s, and the run from 0 to "
                              "{:.9g} s",
                              first, last, end_time),
                  "give a window, or change simulation.end_time");
}

void require_one_unit(const std::vector<const MeasuredSet*>& sets, Diagnostics& diagnostics) {
  const MeasuredSignal* first = nullptr;
  bool is_mixed = false;
  const MeasuredSignal* bare = nullptr;
  for (const MeasuredSet* set : sets) {
    for (const MeasuredSignal& one : set->signals) {
      if (first == nullptr) first = &one;
      if (!one.has_sigma && bare == nullptr) bare = &one;
      is_mixed = is_mixed || one.unit != first->unit || one.has_sigma != first->has_sigma;
    }
  }
  if (bare == nullptr || !is_mixed) return;
  diagnostics.add(bare->at,
                  fmt::format("'{}' in {} is compared beside others and has no sigma: nothing says "
                              "what its residuals weigh",
                              bare->channel, bare->unit),
                  "sigma = { \"closure.S.force\" = \"0.5 N\", ... } for every channel, or for none "
                  "where all have one unit");
}

InstantSampler::InstantSampler(const MeasuredSet& set, double offset, const StepGrid& grid,
                               bool is_dense) {
  long first = grid.count;
  long last = 0;
  long stride = 0;
  for (const MeasuredSignal& signal : set.signals) {
    std::vector<Place>& places = places_.emplace_back();
    for (const double time : signal.times) {
      const double steps = (time + offset) / grid.h;
      const double slack = kOnStep * std::max(1.0, std::abs(steps));
      if (steps < -slack || steps > static_cast<double>(grid.count) + slack) {
        throw InvalidPoint(
            fmt::format("the run, of {:.9g} s, does not reach {:.9g} s, where "
                        "'{}' was measured",
                        grid.h * static_cast<double>(grid.count), time + offset, signal.channel));
      }
      const double nearest = std::round(steps);
      const bool is_on_step = std::abs(steps - nearest) <= slack;
      const double below = is_on_step ? nearest : std::floor(steps);
      const Place place{static_cast<long>(below), is_on_step ? 0.0 : steps - below};
      places.push_back(place);
      first = std::min(first, place.step);
      last = std::max(last, place.step + (is_on_step ? 0 : 1));
      stride = std::gcd(stride, place.step - places.front().step);
      if (!is_on_step) stride = 1;
    }
    stride = std::gcd(stride, places.front().step - places_.front().front().step);
  }
  sampling_ = is_dense ? Sampling{0, grid.count, 1} : Sampling{first, last, std::max(1L, stride)};
}

std::vector<double> InstantSampler::simulated(const MeasuredSet& set, const Series& series) const {
  std::vector<double> values;
  const std::size_t width = series.channels.size();
  const auto value_at = [&](long step, std::size_t column) {
    const long row = (step - sampling_.begin) / sampling_.stride;
    return series.values.at(static_cast<std::size_t>(row) * width + column);
  };
  for (std::size_t i = 0; i < set.signals.size(); ++i) {
    for (const Place& place : places_[i]) {
      const double here = value_at(place.step, i);
      const double next = place.part > 0.0 ? value_at(place.step + 1, i) : here;
      values.push_back(here + place.part * (next - here));
    }
  }
  return values;
}

std::vector<double> InstantSampler::residuals(const MeasuredSet& set, const Series& series) const {
  std::vector<double> residuals = simulated(set, series);
  std::size_t next = 0;
  for (const MeasuredSignal& signal : set.signals) {
    for (const double measured : signal.values) {
      residuals[next] = (residuals[next] - measured) / signal.sigma;
      ++next;
    }
  }
  return residuals;
}

}  // namespace linkstudy
