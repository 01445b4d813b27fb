// Coordinate projection: returns a state to the constraint manifold of the cut joints that ask for
// it, moving along M^-1 J^T (the nearest point in the mass metric):
//   q := q - M^-1 J^T A^-1 Phi,   v := v - M^-1 J^T A^-1 J v,   A = J M^-1 J^T.
// One Newton step; the drift of one integration step is far inside its quadratic range.
#pragma once

#include "core/closures/cut_joint.h"

namespace linkstudy {

// Solves for the rows of projecting closures only; rows of the others get zero.
// schur_rhs holds the residual to remove; dv := -M^-1 J^T A^-1 schur_rhs.
template <class Real>
inline void solve_correction(const Mechanism& m, Workspace<Real>& w, Velocities<Real> dv) {
  solve_schur(m, w);
  for (const VelocityIndex k : velocities(m)) dv[k] = Real(0.0);
  subtract_constraint_forces(m, w, dv);
  for (const VelocityIndex k : velocities(m)) dv[k] = dv[k] * w.inverse_pivot[k];
  solve_branch(m, w.mass.view(), dv);
}

[[gnu::always_inline]] inline bool projects(const Mechanism& m, RowIndex row) {
  const Row& r = m.cut_rows[row];
  return is_of_coupling(r.kind) || m.closures[r.closure].stabilization == Stabilization::projection;
}

// Kinematics and mass matrix factor of (q, v) are in w. dv is (nv) scratch.
template <class Real>
inline void project(const Mechanism& m, const Parameters<Real>& p, Positions<Real> q,
                    Velocities<Real> v, Velocities<Real> dv, Workspace<Real>& w) {
  update_rows<RowStorage::cut>(m, p, w);
  update_constraint_factor(m, p, w);
  update_schur_complement(m, p, w);
  for (const RowIndex r : indices_of(m.cut_rows)) {
    w.schur_rhs[r] = projects(m, r) ? w.cut_rows[r].d : Real(0.0);
  }
  solve_correction(m, w, dv);
  displace(m, dv, q.data());
  for (const RowIndex r : indices_of(m.cut_rows)) {
    w.schur_rhs[r] = projects(m, r) ? w.cut_rows[r].rate : Real(0.0);
  }
  solve_correction(m, w, dv);
  for (const VelocityIndex k : velocities(m)) v[k] = v[k] + dv[k];
}

}  // namespace linkstudy
