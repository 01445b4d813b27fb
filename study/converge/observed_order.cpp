#include "study/converge/observed_order.h"

#include <cmath>
#include <limits>

#include "core/numerics/bracketed_root.h"

namespace linkstudy::convergence {
namespace {

constexpr double kMostOrder = 64.0;  // beyond it the finer difference is nothing but rounding

}  // namespace

std::optional<double> order_of_differences(double e21, double e32, double r21, double r32) {
  const double quotient = e32 / e21;
  const double s21 = std::log(r21);
  const double s32 = std::log(r32);
  if (!(quotient > s32 / s21) || !std::isfinite(quotient)) return std::nullopt;
  const auto excess = [&](double p) {
    return std::log(std::expm1(p * s32) / -std::expm1(-p * s21)) - std::log(quotient);
  };
  const double low = 1e-9;
  const double at_low = excess(low);
  if (at_low >= 0.0) return std::nullopt;
  const double at_high = excess(kMostOrder);
  if (!(at_high > 0.0)) return std::nullopt;
  const Bracket root = bracket_root(excess, low, kMostOrder, at_low, at_high);
  return 0.5 * (root.first + root.second);
}

double order_of_errors(double e1, double e2, double r21) {
  if (!(std::abs(e1) > 0.0) || !(std::abs(e2) > 0.0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::log(std::abs(e2 / e1)) / std::log(r21);
}

}  // namespace linkstudy::convergence
