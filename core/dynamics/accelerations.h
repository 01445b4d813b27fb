// Accelerations and multipliers from generalised forces: M qdd + J^T lambda = tau with the factors
// that the Workspace holds.
#pragma once

#include "core/closures/cut_joint.h"

namespace linkstudy {

template <class Real>
inline void solve_accelerations(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  for (const VelocityIndex k : velocities(m)) w.y[k] = w.tau[k];
  solve_branch_transposed(m, w.mass.view(), Velocities<Real>(w.y));
  solve_cut_joints(m, p, w);
  for (const VelocityIndex k : velocities(m)) w.qdd[k] = w.y[k] * w.inverse_pivot[k];
  solve_branch(m, w.mass.view(), Velocities<Real>(w.qdd));
}

}  // namespace linkstudy
