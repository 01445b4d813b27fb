#include "study/metrics/measured_match.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "study/config/measured_reader.h"

namespace linkstudy {
namespace {

constexpr double kInstantSlack = 1e-9;  // relative: times such as 0.1 + 0.2 in windows to 0.3

// The channel that a component is compared with: closure.S.force.x of closure.S.force is
// rig.force.x of rig.force.
std::string measured_name(const MatchInput& match, const Channel& component) {
  if (!component.name.starts_with(match.signal)) return component.name;
  return match.reference_signal + component.name.substr(match.signal.size());
}

const Location& window_place(const MatchInput& match) {
  return match.window && match.window->at.file ? match.window->at : match.at;
}

// Sum of w f over that of w.
double mean_over_time(const std::vector<double>& times, const std::vector<double>& values) {
  const std::size_t n = times.size();
  if (n == 1) return values.front();
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i > 0 ? times[i] - times[i - 1] : 0.0;
    const double after = i + 1 < n ? times[i + 1] - times[i] : 0.0;
    sum += 0.5 * (before + after) * values[i];
  }
  return sum / (times.back() - times.front());
}

ErrorScales find_scales(const MatchInput& match, const MeasuredSet& set) {
  std::vector<double> largest, root_mean;
  std::map<double, double> lengths;  // squared, by instant
  double square = 0.0;
  for (const MeasuredSignal& signal : set.signals) {
    std::vector<double> squares;
    double most = 0.0;
    for (std::size_t i = 0; i < signal.times.size(); ++i) {
      const double r = signal.values[i];
      most = std::max(most, std::abs(r));
      squares.push_back(r * r);
      lengths[signal.times[i]] += r * r;
    }
    const double mean = mean_over_time(signal.times, squares);
    largest.push_back(most);
    root_mean.push_back(std::sqrt(mean));
    square += mean;
  }
  double longest = 0.0;
  for (const auto& [time, length] : lengths) longest = std::max(longest, length);
  return make_scales(match, std::move(largest), std::move(root_mean), std::sqrt(longest),
                     std::sqrt(square));
}

class MeasuredMatches {
 public:
  MeasuredMatches(const StudyInput& input, const MeasuredInput& measured, Diagnostics& diagnostics)
      : input_(input), measured_(measured), data_(*measured.data), diagnostics_(diagnostics) {
    kept_.assign(data_.channels.size(), std::vector<bool>(data_.times.size(), false));
    is_used_.assign(data_.channels.size(), false);
    units_.resize(data_.channels.size());
  }

  MeasuredReference make(const StudySignals& signals) {
    MeasuredReference reference;
    for (std::size_t i = 0; i < input_.match.size(); ++i) {
      reference.match.push_back(make_set(input_.match[i], signals.match[i]));
    }
    report_unused();
    if (!diagnostics_.empty()) return reference;
    for (std::size_t i = 0; i < input_.match.size(); ++i) {
      reference.scales.push_back(find_scales(input_.match[i], reference.match[i]));
    }
    reference.traces = make_traces();
    return reference;
  }

 private:
  MeasuredSet make_set(const MatchInput& match, const std::vector<Channel>& components) {
    if (match.cycle) {
      diagnostics_.add(match.cycle->at,
                       "a cycle is that of a reference run, and this match is compared with data",
                       "give a window");
    }
    MeasuredSet set;
    std::vector<std::string> missing;
    for (const Channel& component : components) {
      const std::string name = measured_name(match, component);
      const auto found = std::ranges::find(data_.channels, name, &MeasuredChannel::channel);
      if (found == data_.channels.end()) {
        missing.push_back(name);
        continue;
      }
      const auto at = static_cast<std::size_t>(found - data_.channels.begin());
      is_used_[at] = true;
      units_[at] = component.unit;
      if (!fits_unit(*found, component, diagnostics_)) continue;
      set.signals.push_back(make_signal(match, component, at));
    }
    if (!missing.empty()) report_missing(match, missing);
    return set;
  }

  MeasuredSignal make_signal(const MatchInput& match, const Channel& component, std::size_t at) {
    MeasuredSignal signal{component.name, component.unit, 1.0, false, {}, {}, match.at};
    const MeasuredChannel& channel = data_.channels[at];
    for (std::size_t i = 0; i < data_.times.size(); ++i) {
      const double time = instant(i);
      if (std::isnan(channel.values[i]) || !counts(match.window, time)) continue;
      kept_[at][i] = true;
      signal.times.push_back(time);
      signal.values.push_back(match.reference_sign * channel.values[i]);
    }
    if (signal.times.empty()) {
      diagnostics_.add(
          window_place(match),
          fmt::format("'{}' was not measured inside the window of this match", channel.channel),
          "widen the window, or take the column out");
    }
    return signal;
  }

  double instant(std::size_t i) const { return data_.times[i] + measured_.time_offset; }

  // Without a window all but the start of the run, where an unloaded spring never matches.
  bool counts(const std::optional<TimeWindow>& window, double time) const {
    const double slack = kInstantSlack * std::abs(window ? window->last : data_.times.back());
    if (!window) return std::abs(time) > slack;
    return window->first - slack <= time && time <= window->last + slack;
  }

  void report_missing(const MatchInput& match, const std::vector<std::string>& missing) {
    std::vector<std::string> names;
    for (const MeasuredChannel& one : data_.channels) names.push_back(one.channel);
    diagnostics_.add(match.at,
                     fmt::format("'{}' compares {}, which '{}' does not have as a column",
                                 match.signal, fmt::join(missing, ", "), source_name(measured_)),
                     fmt::format("measured are: {}; name a single component in the match",
                                 fmt::join(names, ", ")));
  }

  void report_unused() {
    for (std::size_t i = 0; i < is_used_.size(); ++i) {
      if (is_used_[i]) continue;
      const MeasuredChannel& one = data_.channels[i];
      diagnostics_.add(one.at, fmt::format("no [[match]] compares '{}'", one.channel),
                       "take the column out, or name it as signal or reference_signal of a match");
    }
  }

  std::vector<Trace> make_traces() const {
    std::vector<Trace> traces = {{"time", "s", {}}};
    for (const MeasuredChannel& one : data_.channels) {
      traces.push_back({one.channel, units_[traces.size() - 1], {}});
    }
    for (std::size_t i = 0; i < data_.times.size(); ++i) {
      const auto keeps = [i](const std::vector<bool>& kept) { return kept[i]; };
      if (std::ranges::none_of(kept_, keeps)) continue;
      traces.front().values.push_back(instant(i));
      for (std::size_t c = 0; c < kept_.size(); ++c) {
        const double missing = std::numeric_limits<double>::quiet_NaN();
        traces[c + 1].values.push_back(kept_[c][i] ? data_.channels[c].values[i] : missing);
      }
    }
    return traces;
  }

  const StudyInput& input_;
  const MeasuredInput& measured_;
  const MeasuredData& data_;
  Diagnostics& diagnostics_;
  std::vector<std::vector<bool>> kept_;  // by channel and instant: some match compares it
  std::vector<bool> is_used_;            // by channel
  std::vector<std::string> units_;       // likewise, of the component compared with it
};

}  // namespace

MeasuredReference make_measured_reference(const StudyInput& input, const MeasuredInput& measured,
                                          const StudySignals& signals, Diagnostics& diagnostics) {
  return MeasuredMatches(input, measured, diagnostics).make(signals);
}

MeasuredMatch::MeasuredMatch(const MeasuredReference& reference, std::size_t match,
                             const StepGrid& grid)
    : set_(reference.match.at(match)),
      scales_(reference.scales.at(match)),
      sampler_(set_, 0.0, grid, false) {}

std::vector<double> MeasuredMatch::reduce(const Series& series) const {
  const std::vector<double> simulated = sampler_.simulated(set_, series);
  std::vector<double> errors, root_mean;
  std::size_t next = 0;
  for (std::size_t c = 0; c < set_.signals.size(); ++c) {
    const MeasuredSignal& signal = set_.signals[c];
    std::vector<double> squares;
    double most = 0.0;
    for (const double measured : signal.values) {
      const double error = std::abs(simulated[next++] - measured);
      most = std::max(most, error);
      squares.push_back(error * error);
    }
    errors.push_back(relative_error(most, scales_.max[c]));
    root_mean.push_back(
        relative_error(std::sqrt(mean_over_time(signal.times, squares)), scales_.rms[c]));
  }
  errors.insert(errors.end(), root_mean.begin(), root_mean.end());
  return errors;
}

}  // namespace linkstudy
