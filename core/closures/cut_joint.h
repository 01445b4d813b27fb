// Cut joints closed by multipliers ([Urbas16] eq. (18.3)):
//   M qdd + J^T lambda = tau,   J qdd + bias = s,
// s = 0, or -2 alpha Phi_dot - beta^2 Phi with Baumgarte's stabilisation ([AugUrb18] eq. (9)).
// With M = L^T D L and Y = L^-T J^T the Schur complement is A = Y^T D^-1 Y, and
//   A lambda = Y^T D^-1 (L^-T tau) + bias - s.
// lambda_r is the closure force of row r on chain 1 (N or N m). Redundant rows get the multipliers
// of least norm; Workspace::row_inverse tells them.
#pragma once

#include <type_traits>

#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/branch_sparse.h"
#include "core/numerics/semidefinite.h"

namespace linkstudy {

// A row is dependent when its pivot in J M^-1 J^T falls below this part of the largest diagonal: a
// row that vanishes up to rounding has a diagonal of the same rounding and must not vouch for
// itself.
inline constexpr double kDependentRow = 1e-10;

// Rows of J of one closure, zero off its support.
template <class Real>
inline void update_closure_jacobian(const Mechanism& m, const Parameters<Real>& p,
                                    const Workspace<Real>& w, std::size_t closure, Real* j) {
  const ClosureStructure& c = m.closures[closure];
  const int nv = m.nv;
  const int rows = c.row_end - c.row_begin;
  for (int n = 0; n < rows; ++n) {
    for (int k : c.support) j[n * nv + k] = Real(0.0);
  }
  int n = 0;
  if (c.point_rows) {
    add_point_rates(m, p, w, c.last_1, w.closures[closure].p1, true, j);
    add_point_rates(m, p, w, c.last_2, w.closures[closure].p2, false, j);
    n = 3;
  }
  for (; n < rows; ++n) {
    const auto r = static_cast<std::size_t>(c.row_begin + n);
    add_row_rates(m, p, w, m.cut_rows[r], w.cut_rows[r], j + n * nv);
  }
}

// Y = L^-T J^T by rows.
template <class Real>
inline void update_constraint_factor(const Mechanism& m, const Parameters<Real>& p,
                                     Workspace<Real>& w) {
  const Real* h = w.mass.data();
  const int* parent = m.v_parent.data();
  const int nv = m.nv;
  for (std::size_t i = 0; i < m.closures.size(); ++i) {
    const ClosureStructure& c = m.closures[i];
    if (c.model != ClosureModel::cut) continue;
    Real* y = w.cut_y.data() + c.row_begin * nv;
    update_closure_jacobian(m, p, w, i, y);
    const int rows = c.row_end - c.row_begin;
    for (int k : c.support) {
      for (int a = parent[k]; a >= 0; a = parent[a]) {
        const Real l = h[k * nv + a];
        for (int n = 0; n < rows; ++n) y[n * nv + a] = nmadd(l, y[n * nv + k], y[n * nv + a]);
      }
    }
  }
}

// Calls f with the number of cut rows, as a constant for the commonest: one spherical joint.
template <class F>
inline void with_row_count(const Mechanism& m, F&& f) {
  const int nc = m.cut_row_count();
  if (nc == 3) {
    f(std::integral_constant<int, 3>());
  } else {
    f(nc);
  }
}

// A = Y^T D^-1 Y, (nc, nc), summed over the velocities that reach some closure.
template <class Size, class Real>
inline void sum_schur_complement(Size nc, const Mechanism& m, Workspace<Real>& w) {
  const int nv = m.nv;
  const Real* inverse_pivot = w.inverse_pivot.data();
  const Real* y = w.cut_y.data();
  Real* a = w.schur.data();
  for (int r = 0; r < nc; ++r) {
    const auto row = static_cast<std::size_t>(r);
    const ClosureStructure& c = m.closures[static_cast<std::size_t>(m.cut_rows[row].closure)];
    for (int s = 0; s <= r; ++s) {
      Real sum(0.0);
      for (int k : c.support) sum = madd(y[r * nv + k] * inverse_pivot[k], y[s * nv + k], sum);
      a[r * nc + s] = sum;
    }
  }
}

template <class Real>
inline void update_schur_complement(const Mechanism& m, Workspace<Real>& w) {
  with_row_count(m, [&](auto nc) {
    sum_schur_complement(nc, m, w);
    w.redundant =
        factorize_semidefinite(nc, Real(kDependentRow), w.schur.data(), w.row_inverse.data());
  });
}

// schur_rhs := A^-1 schur_rhs
template <class Real>
inline void solve_schur(const Mechanism& m, Workspace<Real>& w) {
  if (w.redundant) {
    solve_least_norm(m.cut_row_count(), w.schur.data(), w.row_inverse.data(), w.gram.data(),
                     w.scratch.data(), w.schur_rhs.data());
    return;
  }
  with_row_count(m, [&](auto nc) {
    solve_definite(nc, w.schur.data(), w.row_inverse.data(), w.schur_rhs.data());
  });
}

// Y^T D^-1 x for row r
template <class Real>
inline Real project_on_row(const Mechanism& m, const Workspace<Real>& w, int r, const Real* x) {
  const ClosureStructure& c =
      m.closures[static_cast<std::size_t>(m.cut_rows[static_cast<std::size_t>(r)].closure)];
  const Real* y = w.cut_y.data() + r * m.nv;
  Real sum(0.0);
  for (int k : c.support) {
    sum = madd(y[k] * w.inverse_pivot[static_cast<std::size_t>(k)], x[k], sum);
  }
  return sum;
}

// x := x - Y schur_rhs
template <class Real>
inline void subtract_constraint_forces(const Mechanism& m, const Workspace<Real>& w, Real* x) {
  for (std::size_t r = 0; r < m.cut_rows.size(); ++r) {
    const ClosureStructure& c = m.closures[static_cast<std::size_t>(m.cut_rows[r].closure)];
    const Real* y = w.cut_y.data() + r * static_cast<std::size_t>(m.nv);
    const Real lambda = w.schur_rhs[r];
    for (int k : c.support) x[k] = nmadd(lambda, y[k], x[k]);
  }
}

// Multipliers for L^-T tau in Workspace::y; leaves L^-T (tau - J^T lambda) there.
template <class Real>
inline void solve_cut_joints(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  if (m.cut_rows.empty()) return;
  update_rows(m, p, ClosureModel::cut, w);
  update_constraint_factor(m, p, w);
  update_schur_complement(m, w);
  for (int r = 0; r < m.cut_row_count(); ++r) {
    const auto i = static_cast<std::size_t>(r);
    const RowState<Real>& row = w.cut_rows[i];
    const auto& n = p.closures[static_cast<std::size_t>(m.cut_rows[i].closure)];
    const Real stabilized = madd(n.velocity_gain, row.rate, madd(n.position_gain, row.d, row.bias));
    w.schur_rhs[i] = project_on_row(m, w, r, w.y.data()) + stabilized;
  }
  solve_schur(m, w);
  for (std::size_t r = 0; r < m.cut_rows.size(); ++r) w.cut_rows[r].value = w.schur_rhs[r];
  for (std::size_t i = 0; i < m.closures.size(); ++i) {
    const ClosureStructure& c = m.closures[i];
    if (c.model != ClosureModel::cut) continue;
    sum_row_forces(c, m.cut_rows.data(), w.cut_rows.data(), w.closures[i]);
  }
  subtract_constraint_forces(m, w, w.y.data());
}

}  // namespace linkstudy
