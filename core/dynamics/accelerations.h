// Accelerations and multipliers from generalised forces: M qdd + J^T lambda = tau with the factors
// that the Workspace holds.
#pragma once

#include "core/closures/cut_joint.h"

namespace linkstudy {

template <class Real>
inline void solve_accelerations(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  for (const int k : velocities(m)) at(w.y, k) = at(w.tau, k);
  solve_branch_transposed(m, w.mass.data(), w.y.data());
  solve_cut_joints(m, p, w);
  for (const int k : velocities(m)) at(w.qdd, k) = at(w.y, k) * at(w.inverse_pivot, k);
  solve_branch(m, w.mass.data(), w.qdd.data());
}

}  // namespace linkstudy
