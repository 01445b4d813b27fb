// What statistics of n blocks are worth: percentile intervals of a bootstrap (Efron and Tibshirani,
// An Introduction to the Bootstrap, 1993, chapter 13) over whole blocks, which are independent
// where the points in one are not. Resamples follow from the seed.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace linkstudy::sensitivity {

inline constexpr std::size_t kResamples = 1000;
inline constexpr double kConfidence = 0.95;

struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool contains(double value) const { return low <= value && value <= high; }
};

// Of the blocks `rows`.
using Statistics = std::function<std::vector<double>(std::span<const std::size_t> rows)>;

// An interval for each statistic; of those that no resample has (NaN), NaN.
std::vector<Interval> bootstrap_intervals(std::size_t n, std::uint64_t seed,
                                          const Statistics& statistics);

// The value below which a share `p` of the sorted numbers lies, straight between neighbours; NaN of
// none.
double sorted_quantile(std::span<const double> sorted, double p);

// How many blocks would tell an estimate from 0, its interval narrowing as 1/sqrt(n); an estimate
// below `least` in size is not worth telling, and one of `least` is asked for.
double blocks_to_settle(double estimate, const Interval& interval, std::size_t n, double least);

}  // namespace linkstudy::sensitivity
