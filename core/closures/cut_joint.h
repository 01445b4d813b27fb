// Cut joints closed by multipliers ([Urbas16] eq. (18.3)):
//   M qdd + J^T lambda = tau,   J qdd + bias = s,
// s = 0, or -2 alpha Phi_dot - beta^2 Phi with Baumgarte's stabilisation ([AugUrb18] eq. (9)).
// With M = L^T D L and Y = L^-T J^T the Schur complement is A = Y^T D^-1 Y, and
//   A lambda = Y^T D^-1 (L^-T tau) + bias - s.
// lambda_r is the closure force of row r on chain 1 (N or N m). Redundant rows get the multipliers
// of least norm (core/closures/redundant_rows.h); Workspace::kept_rows counts the independent ones.
#pragma once

#include "core/closures/redundant_rows.h"
#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/branch_sparse.h"
#include "core/numerics/definite.h"

namespace linkstudy {

// Rows of J M^-1 J^T whose pivots all stay above this part of its largest diagonal are independent
// beyond any drift of a resolved motion. Below it nothing is said about dependence: light links and
// closures of other size have small pivots too, and only take the slower way.
inline constexpr double kClearPivot = 1e-4;

// Rows of J of one closure, zero off its support.
template <class M, class C, class Real>
inline void update_closure_jacobian(const M& m, const Parameters<Real>& p,
                                    const Workspace<Real, M>& w, C closure, Real* j) {
  const int nv = m.nv;
  const int begin = row_begin(m, closure);
  for_rows(m, closure, [&](auto r) {
    for_support(m, closure, [&](auto k) { j[(r - begin) * nv + k] = Real(0.0); });
  });
  if (at(m.closures, closure).point_rows) add_point_rates(m, p, w, closure, j);
  for_other_rows(m, closure, [&](auto r) {
    add_row_rates(m, p, w, closure, at(m.cut_rows, r), at(w.cut_rows, r), j + (r - begin) * nv);
  });
}

// Y = L^-T J^T by rows.
template <class M, class Real>
inline void update_constraint_factor(const M& m, const Parameters<Real>& p, Workspace<Real, M>& w) {
  const Real* h = w.mass.data();
  const int nv = m.nv;
  for_closures<ClosureModel::cut>(m, [&](auto c) {
    Real* y = w.cut_y.data();
    update_closure_jacobian(m, p, w, c, y + row_begin(m, c) * nv);
    for_support(m, c, [&](auto k) {
      for_ancestors(m, k, [&](auto a) {
        const Real l = h[k * nv + a];
        for_rows(m, c, [&](auto r) { y[r * nv + a] = nmadd(l, y[r * nv + k], y[r * nv + a]); });
      });
    });
  });
}

// Calls f with the number of cut rows, as a constant for the commonest: one spherical joint.
template <class M, class F>
inline void with_row_count(const M& m, F&& f) {
  const auto nc = cut_row_count(m);
  if constexpr (Constant<decltype(cut_row_count(m))>) {
    f(nc);
  } else if (nc == 3) {
    f(Index<3>());
  } else {
    f(nc);
  }
}

// The closure of a row.
template <class M, class R>
inline auto closure_of(const M& m, R r) {
  return structural(m, r, [](const auto& s, int i) { return at(s.cut_rows, i).closure; });
}

// A = Y^T D^-1 Y, (nc, nc), summed over the velocities that reach some closure.
template <class Size, class M, class Real>
inline void sum_schur_complement(Size nc, const M& m, Workspace<Real, M>& w) {
  const int nv = m.nv;
  const Real* y = w.cut_y.data();
  Real* a = w.schur.data();
  for_range(Index<0>(), nc, [&](auto r) {
    for_range(Index<0>(), successor(r), [&](auto s) {
      Real sum(0.0);
      for_support(m, closure_of(m, r), [&](auto k) {
        sum = madd(y[r * nv + k] * at(w.inverse_pivot, k), y[s * nv + k], sum);
      });
      a[r * nc + s] = sum;
    });
  });
}

template <class M, class Real>
inline void update_schur_complement(const M& m, const Parameters<Real>& p, Workspace<Real, M>& w) {
  with_row_count(m, [&](auto nc) {
    sum_schur_complement(nc, m, w);
    const auto clear =
        factorize_definite(nc, Real(kClearPivot), w.schur.data(), w.row_inverse.data());
    w.redundant = lane_bits(clear) ^ kAllLanes<Real>;
  });
  w.kept_rows = Real(static_cast<double>(cut_row_count(m)));
  if constexpr (!FixedStructure<M>) {
    if (w.redundant == 0) return;
    for_closures<ClosureModel::cut>(m, [&](auto c) {
      update_closure_jacobian(m, p, w, c, w.cut_jacobian.data() + row_begin(m, c) * m.nv);
    });
    factorize_redundant_rows(m, p, w);
  }
}

// schur_rhs := A^-1 schur_rhs; where the structure is fixed, only in lanes that are not redundant.
template <class M, class Real>
inline void solve_schur(const M& m, Workspace<Real, M>& w) {
  if constexpr (!FixedStructure<M>) {
    if (w.redundant != 0) take_redundant_rows(m, w);
  }
  if (FixedStructure<M> || w.redundant != kAllLanes<Real>) {
    with_row_count(m, [&](auto nc) {
      solve_definite(nc, w.schur.data(), w.row_inverse.data(), w.schur_rhs.data());
    });
  }
  if constexpr (!FixedStructure<M>) {
    if (w.redundant != 0) give_redundant_rows(m, w);
  }
}

// Y^T D^-1 x for row r
template <class M, class R, class Real>
inline Real project_on_row(const M& m, const Workspace<Real, M>& w, R r, const Real* x) {
  const Real* y = w.cut_y.data() + r * m.nv;
  Real sum(0.0);
  for_support(m, closure_of(m, r),
              [&](auto k) { sum = madd(y[k] * at(w.inverse_pivot, k), x[k], sum); });
  return sum;
}

// x := x - Y schur_rhs
template <class M, class Real>
inline void subtract_constraint_forces(const M& m, const Workspace<Real, M>& w, Real* x) {
  for_range(Index<0>(), cut_row_count(m), [&](auto r) {
    const Real* y = w.cut_y.data() + r * m.nv;
    const Real lambda = at(w.schur_rhs, r);
    for_support(m, closure_of(m, r), [&](auto k) { x[k] = nmadd(lambda, y[k], x[k]); });
  });
}

// What does not depend on forces: closure poses (of those whose rows are all idle, too), rows and
// the factor of A.
template <class M, class Real>
inline void update_cut_joints(const M& m, const Parameters<Real>& p, Workspace<Real, M>& w) {
  update_rows<ClosureModel::cut>(m, p, w);
  if (m.cut_rows.empty()) return;
  update_constraint_factor(m, p, w);
  update_schur_complement(m, p, w);
}

// Multipliers for L^-T tau in Workspace::y; leaves L^-T (tau - J^T lambda) there.
template <class M, class Real>
inline void solve_cut_joints(const M& m, const Parameters<Real>& p, Workspace<Real, M>& w) {
  if (m.cut_rows.empty()) return;
  for_range(Index<0>(), cut_row_count(m), [&](auto r) {
    const RowState<Real>& row = at(w.cut_rows, r);
    const ClosureParameters<Real>& n = at(p.closures, closure_of(m, r));
    const Real stabilized = madd(n.velocity_gain, row.rate, madd(n.position_gain, row.d, row.bias));
    at(w.schur_rhs, r) = project_on_row(m, w, r, w.y.data()) + stabilized;
  });
  solve_schur(m, w);
  for_range(Index<0>(), cut_row_count(m),
            [&](auto r) { at(w.cut_rows, r).value = at(w.schur_rhs, r); });
  sum_row_forces<ClosureModel::cut>(m, w);
  subtract_constraint_forces(m, w, w.y.data());
}

}  // namespace linkstudy
