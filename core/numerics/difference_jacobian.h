// df/dy and df/dt of y' = f(t, y) by central differences. Each column has an increment of its own:
// 1e-8 times the size of its unknown, which counts as no smaller than `floor`. One-sided ones cost
// half and are not enough: a contact pressed in by less than a micrometre is far from linear over
// such increments, and an implicit method whose Jacobian errs takes many times the steps.
#pragma once

#include <vector>

#include "core/numerics/adaptive_integrator.h"

namespace linkstudy {

class DifferenceJacobian {
 public:
  // passive: trailing unknowns that f does not depend on; their columns are zero.
  DifferenceJacobian(std::vector<double> floor, int passive);

  // span: a time over which f changes little, s. Evaluates f twice for every unknown that is not
  // passive, and twice for the time.
  void update(const Slopes& f, double t, const double* y, double span);

  double by_unknown(int row, int column) const {
    return by_unknown_[static_cast<std::size_t>(column)][static_cast<std::size_t>(row)];
  }
  const std::vector<double>& by_time() const { return by_time_; }

 private:
  void divide(double way, std::vector<double>& column) const;

  std::vector<double> floor_;
  int active_;
  std::vector<std::vector<double>> by_unknown_;  // columns
  std::vector<double> by_time_;
  std::vector<double> moved_, before_;
};

}  // namespace linkstudy
