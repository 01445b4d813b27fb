// Static equilibrium ([Urbas16] sec. 4) by Newton-Raphson:
//   tau(q, v = 0, t) - J^T lambda = 0,   Phi(q) = 0,
// tau from gravity, sdes, springs, actuators and loads at the time of the state, lambda the
// multipliers of the cut joints. Friction and resistances are left out. Joints with hold = true
// stay where they are: their coordinates are no unknowns, and what the hold must bear is reported.
// The stiffness matrix is taken by differences; singular systems (neutral equilibrium, redundant
// rows) are solved in the least-norm sense. Converged: the residual is below 1e-9 of the largest
// weight or load at the state's time, or below what rounding of the positions makes of the stiffest
// element. Where Newton finds nothing from the start it goes downhill first (static_descent.h): a
// load past its limit snaps through.
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/dynamics/static_stability.h"

namespace linkstudy {

struct StaticsReport : StabilityReport {
  bool converged = false;
  int iterations = 0;
  bool descended = false;         // Newton found nothing from the start: static_descent.h led on
  double time = 0.0;              // s, at which loads count
  double force_residual = 0.0;    // N, N m
  double closure_residual = 0.0;  // m, 1
  double displacement = 0.0;      // largest change of a joint coordinate from the start
  Eigen::VectorXd multipliers;    // (nc) on chain 1
  // (nv) generalised force of the holds, N or N m, along the coordinate on the child; 0 elsewhere.
  Eigen::VectorXd holding;
  std::string reason;  // of a failure, where it is known
};

// Moves s.q to equilibrium with s.v = 0 at time s.t; s is unchanged if there is no convergence.
StaticsReport solve_statics(const Model& model, State<double>& s);

// The model with the efforts of its holds as loads: at the equilibrium it is at rest.
Model with_holding_efforts(const Model& model, const StaticsReport& report);

}  // namespace linkstudy
