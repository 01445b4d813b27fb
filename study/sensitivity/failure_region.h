// Where in the ranges of the parameters evaluations failed: of each cause and each parameter that
// is a number, least, median and greatest value of those that failed beside those that ran, and how
// far apart they are (the largest difference of both distribution functions, of Kolmogorov and
// Smirnov; 1: no value of one lies among the other's).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/record/evaluation.h"

namespace linkstudy::sensitivity {

struct Spread {
  double low = 0.0;
  double median = 0.0;
  double high = 0.0;
};

struct FailureRegion {
  Cause cause = Cause::exception;
  std::size_t count = 0;
  std::size_t ok = 0;
  std::size_t parameter = 0;  // by position
  Spread failed;
  Spread ran;  // NaN where none did
  double separation = 0.0;
};

// By cause, then by parameter; empty where nothing failed.
std::vector<FailureRegion> find_failure_regions(
    const std::map<std::uint64_t, Evaluation>& evaluations);

// The largest difference of the distribution functions of two sorted samples; NaN where one is
// empty.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace linkstudy::sensitivity
