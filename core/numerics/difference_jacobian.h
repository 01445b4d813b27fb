// df/dy of y' = f(t, y) by central differences. Each column has an increment of its own:
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

  // Evaluates f twice for every unknown that is not passive.
  void update(const Slopes& f, double t, const double* y);

  double by_unknown(int row, int column) const {
    return by_unknown_[static_cast<std::size_t>(column)][static_cast<std::size_t>(row)];
  }

 private:
  void divide(double way, std::vector<double>& column) const;

  std::vector<double> floor_;
  int active_;
  std::vector<std::vector<double>> by_unknown_;  // columns
  std::vector<double> moved_, before_;
};

}  // namespace linkstudy
