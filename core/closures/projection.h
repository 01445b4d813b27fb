// Coordinate projection: returns a state to the constraint manifold of the cut joints that ask for
// it, moving along M^-1 J^T (the nearest point in the mass metric):
//   q := q - M^-1 J^T A^-1 Phi,   v := v - M^-1 J^T A^-1 J v,   A = J M^-1 J^T.
// One Newton step; the drift of one integration step is far inside its quadratic range.
#pragma once

#include "core/closures/cut_joint.h"

namespace linkstudy {

// Solves for the rows of projecting closures only; rows of the others get zero.
// target[r] is the residual to remove; dv := -M^-1 J^T A^-1 target.
template <class Real>
inline void solve_correction(const Mechanism& m, Workspace<Real>& w, Real* dv) {
  solve_schur(m, w);
  for (int k = 0; k < m.nv; ++k) dv[k] = Real(0.0);
  subtract_constraint_forces(m, w, dv);
  for (int k = 0; k < m.nv; ++k) dv[k] = dv[k] * w.inverse_pivot[static_cast<std::size_t>(k)];
  solve_branch(m.nv, m.v_parent.data(), w.mass.data(), dv);
}

template <class Real>
inline bool projects(const Mechanism& m, std::size_t row) {
  const auto closure = static_cast<std::size_t>(m.cut_rows[row].closure);
  return m.closures[closure].stabilization == Stabilization::projection;
}

// Precondition: kinematics and mass matrix factor of (q, v) are in w. dv is (nv) scratch.
template <class Real>
inline void project(const Mechanism& m, const Parameters<Real>& p, Real* q, Real* v, Real* dv,
                    Workspace<Real>& w) {
  update_rows(m, p, ClosureModel::cut, w);
  update_constraint_factor(m, p, w);
  update_schur_complement(m, w);
  for (std::size_t r = 0; r < m.cut_rows.size(); ++r) {
    w.schur_rhs[r] = projects<Real>(m, r) ? w.cut_rows[r].d : Real(0.0);
  }
  solve_correction(m, w, dv);
  displace(m, dv, q);
  for (std::size_t r = 0; r < m.cut_rows.size(); ++r) {
    w.schur_rhs[r] = projects<Real>(m, r) ? w.cut_rows[r].rate : Real(0.0);
  }
  solve_correction(m, w, dv);
  for (int k = 0; k < m.nv; ++k) v[k] = v[k] + dv[k];
}

}  // namespace linkstudy
