// Static equilibrium ([Urbas16] sec. 4) by Newton-Raphson:
//   tau(q, v = 0, t) - J^T lambda = 0,   Phi(q) = 0,
// tau from gravity, sdes and loads, lambda the multipliers of the cut joints. The stiffness matrix
// is taken by differences; singular systems (neutral equilibrium, redundant rows) are solved in the
// least-norm sense. Converged: the residual is below 1e-9 of the largest weight or load at the
// state's time, or below what rounding of the positions makes of the stiffest element.
// Stability: the smallest eigenvalue of the stiffness -d(tau - J^T lambda)/dq on the directions
// that the cut joints leave free; positive: stable. Below the noise of the differences it is
// neutral: 1e-12 of the largest stiffness (or of weights on the mechanism's length), or ten times
// their doubt.
#pragma once

#include <Eigen/Core>

#include "core/model/compile.h"

namespace linkstudy {

enum class Stability { stable, neutral, unstable };

struct StaticsReport {
  bool converged = false;
  int iterations = 0;
  double force_residual = 0.0;    // N, N m
  double closure_residual = 0.0;  // m, 1
  double displacement = 0.0;      // largest change of a joint coordinate from the start
  Stability stability = Stability::neutral;
  double smallest_stiffness = 0.0;  // N/m, N m/rad
  Eigen::VectorXd multipliers;      // (nc) on chain 1
};

// Moves s.q to equilibrium with s.v = 0 at time s.t; s is unchanged if there is no convergence.
StaticsReport solve_statics(const Model& model, State<double>& s);

}  // namespace linkstudy
