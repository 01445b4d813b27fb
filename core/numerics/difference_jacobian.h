// df/dy and df/dt of y' = f(t, y) by one-sided differences. Each column has an increment of its
// own: sqrt(epsilon) times the size of its unknown, which counts as no smaller than `floor`.
#pragma once

#include <vector>

#include "core/numerics/adaptive_integrator.h"

namespace linkstudy {

class DifferenceJacobian {
 public:
  // passive: trailing unknowns that f does not depend on; their columns are zero.
  DifferenceJacobian(std::vector<double> floor, int passive);

  // slopes: f(t, y), known already. span: a time over which f changes little, s.
  // Evaluates f once for every unknown that is not passive, and once for the time.
  void update(const Slopes& f, double t, const double* y, const double* slopes, double span);

  double by_unknown(int row, int column) const {
    return by_unknown_[static_cast<std::size_t>(column)][static_cast<std::size_t>(row)];
  }
  const std::vector<double>& by_time() const { return by_time_; }

 private:
  void divide(const double* slopes, double increment, std::vector<double>& column) const;

  std::vector<double> floor_;
  int active_;
  std::vector<std::vector<double>> by_unknown_;  // columns
  std::vector<double> by_time_;
  std::vector<double> moved_;
};

}  // namespace linkstudy
