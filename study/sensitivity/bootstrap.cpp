#include "study/sensitivity/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/design/random_stream.h"

namespace linkstudy::sensitivity {
namespace {

constexpr std::uint64_t kPurpose = 0x626F6F74;  // apart from the streams of designs

}  // namespace

double sorted_quantile(std::span<const double> sorted, double p) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double part = place - static_cast<double>(below);
  return sorted[below] + part * (sorted[above] - sorted[below]);
}

std::vector<Interval> bootstrap_intervals(std::size_t n, std::uint64_t seed,
                                          const Statistics& statistics) {
  std::vector<std::vector<double>> found;
  std::vector<std::size_t> rows(n);
  for (std::size_t resample = 0; resample < kResamples; ++resample) {
    const RandomStream stream(seed, {kPurpose, resample});
    for (std::size_t i = 0; i < n; ++i) rows[i] = stream.below(n, i);
    const std::vector<double> values = statistics(rows);
    found.resize(values.size());
    for (std::size_t s = 0; s < values.size(); ++s) {
      if (!std::isnan(values[s])) found[s].push_back(values[s]);
    }
  }
  std::vector<Interval> intervals;
  for (std::vector<double>& values : found) {
    std::ranges::sort(values);
    const double tail = (1.0 - kConfidence) / 2.0;
    intervals.push_back({sorted_quantile(values, tail), sorted_quantile(values, 1.0 - tail)});
  }
  return intervals;
}

double blocks_to_settle(double estimate, const Interval& interval, std::size_t n, double least) {
  const double reach = estimate < 0.0 ? interval.high - estimate : estimate - interval.low;
  const double size = std::max(std::abs(estimate), least);
  return std::ceil(static_cast<double>(n) * std::pow(reach / size, 2));
}

}  // namespace linkstudy::sensitivity
