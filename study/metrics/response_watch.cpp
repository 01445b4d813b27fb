#include "study/metrics/response_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/metrics/common_grid.h"
#include "study/metrics/cycle.h"

namespace linkstudy {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();

// A number of a window, and where it was reached.
struct Reduced {
  double value = kUnseen;
  double instant = kUnseen;
  double place = kUnseen;
};

Reduced reduced(const ChannelReduction& r, Reduction how, double h) {
  const double length = total_weight(r.sampling, r.ends);
  if (r.seen == 0) return {};
  const Reduced least{r.min, h * static_cast<double>(r.min_step), r.min_place};
  const Reduced most{r.max, h * static_cast<double>(r.max_step), r.max_place};
  switch (how) {
    case Reduction::max:
      return most;
    case Reduction::min:
      return least;
    case Reduction::max_abs: {
      const bool is_least = std::abs(r.min) > std::abs(r.max);
      Reduced one = is_least ? least : most;
      one.value = std::abs(one.value);
      return one;
    }
    case Reduction::rms:
      return {std::sqrt(r.square / length)};
    case Reduction::mean:
      return {r.sum / length};
    case Reduction::last:
      break;
  }
  return {r.last};
}

// The same as step loops do (lane_observers.h), of a history of every step.
void reduce_history(const Series& history, std::size_t column, ChannelReduction& r) {
  const std::size_t n = history.channels.size();
  for (long step = r.sampling.begin; step <= r.sampling.last(); ++step) {
    const double* row = history.values.data() + static_cast<std::size_t>(step) * n;
    const double x = row[column];
    const double place = r.place.empty() ? 0.0 : row[n - 1];
    if (x < r.min) {
      r.min = x;
      r.min_step = step;
      r.min_place = place;
    }
    if (x > r.max) {
      r.max = x;
      r.max_step = step;
      r.max_place = place;
    }
    const double weight = time_weight(r.sampling, r.ends, step);
    r.sum += weight * x;
    r.square += weight * x * x;
    r.last = x;
    ++r.seen;
  }
}

ChannelReduction over_window(const Channel& channel, const std::vector<Channel>& place,
                             const StepGrid& grid, const std::optional<TimeWindow>& window) {
  ChannelReduction reduction;
  reduction.channel = channel;
  reduction.place = place;
  reduction.sampling = sample_window(grid, 1, window);
  if (!window) reduction.sampling.begin = 0;
  reduction.ends = find_window_ends(grid, reduction.sampling, window);
  return reduction;
}

}  // namespace

ResponseWatch::ResponseWatch(const StudyInput& input, const StudySignals& signals,
                             const StepGrid& grid, Observers& observers)
    : grid_(grid) {
  for (std::size_t i = 0; i < input.response.size(); ++i) {
    const ResponseInput& response = input.response[i];
    const std::vector<Channel>& channels = signals.response[i];
    const auto place = response.where ? signals.response_place.at(i) : std::vector<Channel>();
    Watched one{response, channels.size(), observers.reductions.size()};
    if (response.cycle) {
      one.first = observers.series.size();
      const Sampling every{0, grid.count, 1};
      Series history{channels, every, {}};
      history.channels.insert(history.channels.end(), place.begin(), place.end());
      observers.series.push_back(std::move(history));
      observers.series.push_back({signals.response_cycle[i], every, {}});
      series_count_ += 2;
    } else {
      for (const Channel& channel : channels) {
        observers.reductions.push_back(over_window(channel, place, grid, response.window));
      }
    }
    watched_.push_back(std::move(one));
  }
}

std::optional<std::string> ResponseWatch::missing_turn(const Observers& observers) const {
  for (const Watched& one : watched_) {
    if (!one.response.cycle || one.channels == 0) continue;
    const Series& angle = observers.series[one.first + 1];
    if (find_cycle(*one.response.cycle, angle, grid_.h)) continue;
    return no_cycle_text(*one.response.cycle, angle);
  }
  return std::nullopt;
}

std::vector<ChannelReduction> ResponseWatch::reductions_of(const Watched& one,
                                                           const Observers& observers) const {
  if (!one.response.cycle) {
    const auto first = observers.reductions.begin() + static_cast<std::ptrdiff_t>(one.first);
    return {first, first + static_cast<std::ptrdiff_t>(one.channels)};
  }
  std::vector<ChannelReduction> reductions(one.channels);
  const Series& history = observers.series[one.first];
  const auto window = find_cycle(*one.response.cycle, observers.series[one.first + 1], grid_.h);
  if (!window) return reductions;
  const auto values = history.channels.begin() + static_cast<std::ptrdiff_t>(one.channels);
  const std::vector<Channel> place(values, history.channels.end());
  for (std::size_t c = 0; c < one.channels; ++c) {
    reductions[c] = over_window(history.channels[c], place, grid_, window);
    reduce_history(history, c, reductions[c]);
  }
  return reductions;
}

std::vector<std::vector<double>> ResponseWatch::reduce(const Observers& observers) const {
  std::vector<std::vector<double>> numbers;
  for (const Watched& one : watched_) {
    std::vector<double> values, instants, places;
    for (const ChannelReduction& reduction : reductions_of(one, observers)) {
      const Reduced found = reduced(reduction, one.response.reduce, grid_.h);
      values.push_back(found.value);
      instants.push_back(found.instant);
      places.push_back(found.place);
    }
    const auto& where = one.response.where;
    if (where) values.insert(values.end(), instants.begin(), instants.end());
    if (!where || where->channel.empty()) places.clear();
    values.insert(values.end(), places.begin(), places.end());
    numbers.push_back(std::move(values));
  }
  return numbers;
}

}  // namespace linkstudy
