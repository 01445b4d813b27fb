#include "study/metrics/common_grid.h"

#include <algorithm>
#include <cmath>

namespace linkstudy {
namespace {

constexpr double kTolerance = 1e-9;

}  // namespace

std::optional<CommonGrid> find_common_grid(double step, double reference_step) {
  const double ratio = step / reference_step;
  for (long q = 1; q <= kLargestRatio; ++q) {
    const double p = std::round(ratio * static_cast<double>(q));
    if (p < 1.0 || p > static_cast<double>(kLargestRatio)) continue;
    if (std::abs(p / static_cast<double>(q) - ratio) <= kTolerance * ratio) {
      return CommonGrid{q, static_cast<long>(p)};
    }
  }
  return std::nullopt;
}

Sampling sample_window(const StepGrid& grid, long stride, const std::optional<TimeWindow>& window) {
  const long last_step = grid.count - grid.count % stride;
  if (!window) return {stride, last_step, stride};
  const double interval = grid.h * static_cast<double>(stride);
  // In units of the interval; the slack takes the rounding of times such as 0.5 / 1e-4.
  const double slack = kTolerance * std::max(1.0, window->last / interval);
  const long first = static_cast<long>(std::ceil(window->first / interval - slack));
  const long last = static_cast<long>(std::floor(window->last / interval + slack));
  return {first * stride, std::min(last * stride, last_step), stride};
}

WindowEnds find_window_ends(const StepGrid& grid, const Sampling& sampling,
                            const std::optional<TimeWindow>& window) {
  if (!window || sampling.count() == 0) return {};
  const double h = grid.h;
  const double interval = h * static_cast<double>(sampling.stride);
  const double slack = kTolerance * std::max(1.0, window->last / interval);
  const auto part = [&](double time) {
    const double parts = time / interval;
    return parts > slack ? parts : 0.0;  // an end on a sample is on it in spite of rounding
  };
  return {part(h * static_cast<double>(sampling.begin) - window->first),
          part(window->last - h * static_cast<double>(sampling.last()))};
}

}  // namespace linkstudy
