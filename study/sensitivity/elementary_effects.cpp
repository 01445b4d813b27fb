#include "study/sensitivity/elementary_effects.h"

#include <cmath>
#include <limits>

namespace linkstudy::sensitivity {

std::vector<double> elementary_effects(std::span<const std::vector<double>> points,
                                       std::span<const double> values) {
  const std::size_t k = points.front().size();
  std::vector<double> effects(k, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t s = 0; s + 1 < points.size(); ++s) {
    for (std::size_t i = 0; i < k; ++i) {
      const double moved = points[s + 1][i] - points[s][i];
      if (moved != 0.0) effects[i] = (values[s + 1] - values[s]) / moved;
    }
  }
  return effects;
}

EffectMeasures measure_effects(std::span<const double> effects, std::span<const std::size_t> rows) {
  EffectMeasures measures;
  const auto n = static_cast<double>(rows.size());
  for (const std::size_t row : rows) {
    measures.mu += effects[row] / n;
    measures.mu_star += std::abs(effects[row]) / n;
  }
  if (rows.size() < 2) return measures;
  double squares = 0.0;
  for (const std::size_t row : rows) squares += std::pow(effects[row] - measures.mu, 2);
  measures.sigma = std::sqrt(squares / (n - 1.0));
  return measures;
}

}  // namespace linkstudy::sensitivity
