#include "study/tune/variable_axis.h"

#include <algorithm>
#include <cmath>

namespace linkstudy::tuning {

double from_axis(const TunedVariable& variable, double t) {
  const double value = std::pow(10.0, t);
  // Powers of ten miss the ends by rounding.
  for (const double end : {variable.low, variable.high}) {
    if (std::abs(value - end) <= 1e-12 * end) return end;
  }
  return std::clamp(value, variable.low, variable.high);
}

double move_along(const TunedVariable& variable, double value, double decades) {
  return std::clamp(value * std::pow(10.0, decades), variable.low, variable.high);
}

bool is_below(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j] > b[j]) return false;
  return true;
}

}  // namespace linkstudy::tuning
