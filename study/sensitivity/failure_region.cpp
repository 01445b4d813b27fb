#include "study/sensitivity/failure_region.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/sensitivity/bootstrap.h"

namespace linkstudy::sensitivity {
namespace {

using Values = std::vector<double>;

Spread spread_of(const Values& sorted) {
  return {sorted_quantile(sorted, 0.0), sorted_quantile(sorted, 0.5), sorted_quantile(sorted, 1.0)};
}

}  // namespace

double largest_difference(const Values& a, const Values& b) {
  if (a.empty() || b.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto share = [](const Values& sorted, double x) {
    const auto count = std::ranges::upper_bound(sorted, x) - sorted.begin();
    return static_cast<double>(count) / static_cast<double>(sorted.size());
  };
  double largest = 0.0;
  for (const Values* one : {&a, &b}) {
    for (const double x : *one) largest = std::max(largest, std::abs(share(a, x) - share(b, x)));
  }
  return largest;
}

std::vector<FailureRegion> find_failure_regions(
    const std::map<std::uint64_t, Evaluation>& evaluations) {
  if (evaluations.empty()) return {};
  std::vector<FailureRegion> regions;
  const std::vector<Value>& first = evaluations.begin()->second.point.values;
  for (const auto& word : kWords<Cause>) {
    for (std::size_t i = 0; i < first.size() && word.value != Cause::ok; ++i) {
      if (!std::holds_alternative<double>(first[i])) continue;
      Values failed, ran;
      for (const auto& [id, one] : evaluations) {
        const double value = std::get<double>(one.point.values[i]);
        if (one.status == word.value) failed.push_back(value);
        if (one.status == Cause::ok) ran.push_back(value);
      }
      if (failed.empty()) continue;
      std::ranges::sort(failed);
      std::ranges::sort(ran);
      regions.push_back({word.value, failed.size(), ran.size(), i, spread_of(failed),
                         spread_of(ran), largest_difference(failed, ran)});
    }
  }
  return regions;
}

}  // namespace linkstudy::sensitivity
