// Coordinate projection: returns a state to the constraint manifold of the cut joints that ask for
// it, moving along M^-1 J^T (the nearest point in the mass metric):
//   q := q - M^-1 J^T A^-1 Phi,   v := v - M^-1 J^T A^-1 J v,   A = J M^-1 J^T.
// One Newton step; the drift of one integration step is far inside its quadratic range.
#pragma once

#include "core/closures/cut_joint.h"

namespace linkstudy {

// Solves for the rows of projecting closures only; rows of the others get zero.
// schur_rhs holds the residual to remove; dv := -M^-1 J^T A^-1 schur_rhs.
template <class M, class Real>
inline void solve_correction(const M& m, Workspace<Real, M>& w, Real* dv) {
  solve_schur(m, w);
  for_velocities(m, [&](auto k) { dv[k] = Real(0.0); });
  subtract_constraint_forces(m, w, dv);
  for_velocities(m, [&](auto k) { dv[k] = dv[k] * at(w.inverse_pivot, k); });
  solve_branch(m, w.mass.data(), dv);
}

template <class M>
inline bool projects(const M& m, int row) {
  return at(m.closures, at(m.cut_rows, row).closure).stabilization == Stabilization::projection;
}

// Precondition: kinematics and mass matrix factor of (q, v) are in w. dv is (nv) scratch.
template <class M, class Real>
inline void project(const M& m, const Parameters<Real>& p, Real* q, Real* v, Real* dv,
                    Workspace<Real, M>& w) {
  update_rows<ClosureModel::cut>(m, p, w);
  update_constraint_factor(m, p, w);
  update_schur_complement(m, p, w);
  for_range(Index<0>(), cut_row_count(m),
            [&](auto r) { at(w.schur_rhs, r) = projects(m, r) ? at(w.cut_rows, r).d : Real(0.0); });
  solve_correction(m, w, dv);
  displace(m, dv, q);
  for_range(Index<0>(), cut_row_count(m), [&](auto r) {
    at(w.schur_rhs, r) = projects(m, r) ? at(w.cut_rows, r).rate : Real(0.0);
  });
  solve_correction(m, w, dv);
  for_velocities(m, [&](auto k) { v[k] = v[k] + dv[k]; });
}

}  // namespace linkstudy
