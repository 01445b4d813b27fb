#include "study/design/distribution.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <cmath>

#include "study/record/boost_policy.h"

namespace linkstudy {
namespace {

using Normal = boost::math::normal_distribution<double, IgnoreOverflow>;

// Probabilities of both bounds: below them, or above them where the mean lies below both, so that
// no digits are lost in a tail.
struct Bounds {
  bool is_above = false;
  double low = 0.0;
  double high = 1.0;
};

Bounds bounds_of(const Distribution& d, const Normal& normal) {
  const bool is_above = d.low > d.mean;
  const auto probability = [&](double x) {
    if (std::isinf(x)) return (x > 0.0) == is_above ? 0.0 : 1.0;
    return is_above ? cdf(complement(normal, x)) : cdf(normal, x);
  };
  return {is_above, probability(d.low), probability(d.high)};
}

double normal_quantile(const Distribution& d, double u) {
  const Normal normal(d.mean, d.deviation);
  const Bounds bounds = bounds_of(d, normal);
  const double p = bounds.low + u * (bounds.high - bounds.low);
  const double x = bounds.is_above ? quantile(complement(normal, p)) : quantile(normal, p);
  return std::clamp(x, d.low, d.high);
}

double log_quantile(const Distribution& d, double u) {
  if (u == 0.0 || u == 1.0) return u == 0.0 ? d.low : d.high;
  const double exponent = (1.0 - u) * std::log10(d.low) + u * std::log10(d.high);
  return std::clamp(std::pow(10.0, exponent), d.low, d.high);
}

}  // namespace

double quantile(const Distribution& d, double u) {
  switch (d.law) {
    case Law::lin:
      return d.low * (1.0 - u) + d.high * u;
    case Law::log:
      return log_quantile(d, u);
    case Law::normal:
      return normal_quantile(d, u);
    case Law::triangular:
      break;
  }
  return quantile(boost::math::triangular_distribution<double>(d.low, d.mode, d.high), u);
}

double share_within_bounds(const Distribution& normal) {
  const Bounds bounds = bounds_of(normal, Normal(normal.mean, normal.deviation));
  return std::abs(bounds.high - bounds.low);
}

}  // namespace linkstudy
