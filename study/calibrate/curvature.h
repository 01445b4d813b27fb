// The linear model about the best fit, from its Jacobian with columns scaled to length one,
//   J = U diag(sigma) V' diag(|J_i|):  singular values below 1e-5 of the largest are directions in
// which nothing changes; what is left has the covariance C = (J'J)^+ (times s^2). 1e-5 is ten times
// the error of central differences of 1e-3.
#pragma once

#include "study/calibrate/fit_problem.h"

namespace linkstudy::calibration {

// Relative changes of parameters that leave all residuals as they are.
struct FlatDirection {
  Vector along;      // in the cube, largest entry 1
  std::string name;  // "link.m.mass : closure.S.sde.stiffness = 1 : 1"
  bool holds(Eigen::Index i) const { return std::abs(along[i]) > 0.0; }
};

struct Curvature {
  Matrix covariance;   // C in the cube; infinite variances where flat
  Matrix correlation;  // NaN where flat
  std::vector<double> singular_values;
  std::vector<FlatDirection> flat;
  bool is_flat(Eigen::Index i) const;
};

Curvature compute_curvature(const FitProblem& problem, const Vector& point, const Matrix& jacobian);

}  // namespace linkstudy::calibration
