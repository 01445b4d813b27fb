// Least squares over all levels that are asymptotic (Eca and Hoekstra 2008, J. Mar. Sci. Technol.,
// doi 10.1007/s00773-008-0018-1): phi_0, a and p of
//   phi_i = phi_0 + a h_i^p,     deviation = sqrt(sum (phi_i - phi_0 - a h_i^p)^2 / (n - 3))
// and the order p* with which differences of neighbours fall, whatever their signs: it tells values
// that oscillate about their limit from values that do not approach one.
#pragma once

#include <optional>
#include <span>

namespace linkstudy::convergence {

struct Level {
  double h = 0.0;
  double value = 0.0;
};

struct OrderFit {
  double limit = 0.0;        // phi_0
  double coefficient = 0.0;  // a
  double order = 0.0;        // p
  double deviation = 0.0;    // 0 for three levels, which it meets
  std::size_t count = 0;     // levels
};

// Nothing of fewer than three levels, or where the best order lies at an end of [0.05, 12].
std::optional<OrderFit> fit_order(std::span<const Level> levels);

// Slope of log |difference| over log h of the finer of the two: `differences` are levels of those.
// NaN of fewer than two that are not zero.
double fit_difference_order(std::span<const Level> differences);

}  // namespace linkstudy::convergence
