#include "study/converge/needed_size.h"

#include <cmath>

namespace linkstudy::convergence {
namespace {

constexpr double kFarthest = 32.0;  // beyond the finest level: an order need not hold that far

}  // namespace

NeededSize find_needed_size(std::span<const Level> errors, double wanted, double order) {
  if (errors.empty() || !std::isfinite(wanted)) return {};
  std::size_t enough = errors.size();
  while (enough > 0 && errors[enough - 1].value <= wanted) --enough;
  if (enough == 0) return {errors.front().h, NeededBy::coarsest};
  if (enough == errors.size()) {
    const Level& finest = errors.back();
    if (!(order > 0.0) || std::isnan(finest.value)) return {};
    const double factor = std::pow(wanted / finest.value, 1.0 / order);
    if (factor < 1.0 / kFarthest) return {};
    return {finest.h * factor, NeededBy::extrapolation};
  }
  const Level& good = errors[enough];
  const Level& bad = errors[enough - 1];
  const double slope = std::log(bad.value / good.value) / std::log(bad.h / good.h);
  // A level without an error, or whose error is nothing: no law runs through it.
  if (!(slope > 0.0) || !std::isfinite(slope)) return {good.h, NeededBy::levels};
  return {good.h * std::pow(wanted / good.value, 1.0 / slope), NeededBy::levels};
}

}  // namespace linkstudy::convergence
