#include "study/converge/series_difference.h"

#include <algorithm>
#include <cmath>

namespace linkstudy::convergence {
namespace {

constexpr double kSameInstant = 1e-9;  // of the largest: rounding of i h

using Samples = std::vector<double>;

double slack_of(std::span<const double> times) {
  return times.empty() ? 0.0 : kSameInstant * std::abs(times.back());
}

// Position of an instant, or one past the end.
std::size_t find_instant(std::span<const double> times, double instant, double slack) {
  const auto found = std::ranges::lower_bound(times, instant - slack);
  const bool is_there = found != times.end() && *found <= instant + slack;
  return is_there ? static_cast<std::size_t>(found - times.begin()) : times.size();
}

// Empty where an instant is missing.
Samples sample(const History& history, const std::vector<double>& instants) {
  Samples samples;
  const double slack = slack_of(history.time);
  for (const double instant : instants) {
    const std::size_t at = find_instant(history.time, instant, slack);
    if (at == history.time.size()) return {};
    samples.push_back(history.values[at]);
  }
  return samples;
}

double inner_product(const std::vector<double>& instants, const Samples& a, const Samples& b) {
  double sum = 0.0;
  for (std::size_t i = 1; i < instants.size(); ++i) {
    sum += 0.5 * (instants[i] - instants[i - 1]) * (a[i] * b[i] + a[i - 1] * b[i - 1]);
  }
  return sum / (instants.back() - instants.front());
}

double norm_of(const std::vector<double>& instants, const Samples& x, ErrorNorm norm) {
  if (norm == ErrorNorm::rms) return std::sqrt(inner_product(instants, x, x));
  double most = 0.0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

Samples difference(const Samples& a, const Samples& b) {
  Samples result(a.size());
  std::ranges::transform(a, b, result.begin(), std::minus());
  return result;
}

}  // namespace

std::vector<double> find_common_instants(const std::vector<std::span<const double>>& times,
                                         const std::optional<TimeWindow>& window) {
  std::vector<double> common;
  if (times.empty()) return common;
  for (const double instant : times.front()) {
    const double slack = slack_of(times.front());
    const bool is_in =
        !window || (instant >= window->first - slack && instant <= window->last + slack);
    const auto keeps = [&](std::span<const double> other) {
      return find_instant(other, instant, slack) < other.size();
    };
    if (is_in && std::ranges::all_of(times, keeps)) common.push_back(instant);
  }
  return common;
}

std::optional<SeriesLadder> make_series_ladder(const std::vector<double>& h,
                                               const std::vector<History>& histories,
                                               ErrorNorm norm,
                                               const std::optional<TimeWindow>& window,
                                               const std::optional<History>& reference) {
  std::vector<std::span<const double>> times;
  for (const History& history : histories)
    if (!history.time.empty()) times.push_back(history.time);
  const std::vector<double> instants = find_common_instants(times, window);
  if (instants.size() < 2) return std::nullopt;
  SeriesLadder result;
  result.instants = instants.size();
  result.ladder.h = h;
  result.ladder.has_limit = false;
  const Samples known = reference ? sample(*reference, instants) : Samples();
  std::vector<Samples> samples;
  Samples before, change_before;
  double sign = 1.0;
  for (const History& history : histories) {
    const Samples& x = samples.emplace_back(sample(history, instants));
    const auto norm_or_none = [&](const Samples& of, const Samples& from) {
      return x.empty() || from.empty() ? kUnknown : norm_of(instants, of, norm);
    };
    result.ladder.value.push_back(norm_or_none(x, x));
    result.ladder.error.push_back(
        x.empty() || known.empty() ? kUnknown : norm_of(instants, difference(x, known), norm));
    if (x.empty() || before.empty()) {
      result.ladder.change.push_back(kUnknown);
    } else {
      Samples change = difference(x, before);
      const bool turns =
          !change_before.empty() && inner_product(instants, change, change_before) < 0.0;
      sign = turns ? -sign : sign;
      result.ladder.change.push_back(sign * norm_of(instants, change, norm));
      change_before = std::move(change);
    }
    if (!x.empty()) before = x;
  }
  for (const Samples& x : samples) {
    result.to_finest.push_back(x.empty() ? kUnknown
                                         : norm_of(instants, difference(x, before), norm));
  }
  result.ladder.scale = norm_of(instants, before, norm);
  if (known.empty()) result.ladder.error.clear();
  return result;
}

}  // namespace linkstudy::convergence
