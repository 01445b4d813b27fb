// Cut joints closed by multipliers ([Urbas16] eq. (18.3)):
//   M qdd + J^T lambda = tau,   J qdd + bias = s,
// s = 0, or -2 alpha Phi_dot - beta^2 Phi with Baumgarte's stabilisation ([AugUrb18] eq. (9)).
// With M = L^T D L and Y = L^-T J^T the Schur complement is A = Y^T D^-1 Y, and
//   A lambda = Y^T D^-1 (L^-T tau) + bias - s.
// lambda_r is the closure force of row r on chain 1 (N or N m). Redundant rows get the multipliers
// of least norm (core/closures/redundant_rows.h); Workspace::kept_rows counts the independent ones.
#pragma once

#include "core/closures/clear_rows.h"
#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/branch_sparse.h"
#include "core/numerics/definite.h"

namespace linkstudy {

// Rows of one unit are independent beyond any drift of a resolved motion where the pivots of
// J M^-1 J^T all stay above this part of its largest diagonal. Below it nothing is said about
// dependence: light links and closures of other size have small pivots too, and only take the
// slower way.
inline constexpr double kClearPivot = 1e-4;

// Takes the columns of driven coordinates out of J (core/dynamics/driven_coordinates.h).
template <class Real>
inline void take_driven_columns(const Mechanism& m, Workspace<Real>& w) {
  for (const MotionIndex i : indices_of(m.motions)) {
    for (const RowIndex r : indices_of(m.cut_rows)) {
      Real& entry = w.cut_jacobian(r, m.motions[i].v);
      w.motion_rows(i, r) = entry;
      entry = Real(0.0);
    }
  }
}

// Workspace::cut_jacobian, zero off the supports of the closures and at driven coordinates.
template <class Real>
inline void update_jacobian(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  for (const ClosureIndex c : indices_of(m.closures)) {
    const ClosureStructure& closure = m.closures[c];
    if (storage_of(closure.model) != RowStorage::cut) continue;
    const auto row = [&w](RowIndex r) { return w.cut_jacobian.row(r); };
    for (const RowIndex r : rows_of(closure))
      for (const VelocityIndex k : support_of(m, closure)) row(r)[k] = Real(0.0);
    if (closure.point_rows) {
      const RowIndex first = closure.row_begin;
      add_point_rates(m, p, w, c, row(first), row(first + 1), row(first + 2));
    }
    for (const RowIndex r : other_rows_of(closure)) {
      add_row_rates(m, p, w, c, m.cut_rows[r], w.cut_rows[r], row(r));
    }
  }
  for (const CouplingIndex i : indices_of(m.couplings)) {
    const Velocities<Real> row = w.cut_jacobian.row(m.couplings[i].row);
    for (const VelocityIndex k : support_of(m, m.couplings[i])) row[k] = Real(0.0);
    add_coupling_rates(m, p, i, row);
  }
  take_driven_columns(m, w);
}

// Y = L^-T J^T by rows, from Workspace::cut_jacobian.
template <class Real>
inline void update_constraint_factor(const Mechanism& m, const Parameters<Real>& p,
                                     Workspace<Real>& w) {
  update_jacobian(m, p, w);
  const auto h = w.mass.view();
  const auto y = w.cut_y.view();
  for (const ClosureIndex c : indices_of(m.closures)) {
    const ClosureStructure& closure = m.closures[c];
    if (storage_of(closure.model) != RowStorage::cut) continue;
    for (const RowIndex r : rows_of(closure))
      for (const VelocityIndex k : support_of(m, closure)) y(r, k) = w.cut_jacobian(r, k);
    for (const VelocityIndex k : support_of(m, closure)) {
      for (const VelocityIndex a : ancestors(m, k)) {
        const Real l = h(k, a);
        for (const RowIndex r : rows_of(closure)) y(r, a) = nmadd(l, y(r, k), y(r, a));
      }
    }
  }
  for (const CouplingStructure& c : m.couplings) {
    for (const VelocityIndex k : support_of(m, c)) y(c.row, k) = w.cut_jacobian(c.row, k);
    for (const VelocityIndex k : support_of(m, c)) {
      for (const VelocityIndex a : ancestors(m, k))
        y(c.row, a) = nmadd(h(k, a), y(c.row, k), y(c.row, a));
    }
  }
}

// Calls f with the number of cut rows, as a constant for the commonest: one spherical joint.
template <class F>
inline void with_row_count(const Mechanism& m, F&& f) {
  if (m.cut_row_count() == 3 && !has_rows_of_two_units(m)) {
    f(Three());
  } else {
    f(m.cut_row_count());
  }
}

// A = Y^T D^-1 Y, (nc, nc), summed over the velocities that reach some closure.
template <class Real>
inline void sum_schur_complement(const Mechanism& m, Workspace<Real>& w) {
  const auto y = w.cut_y.view();
  for (const RowIndex r : indices_of(m.cut_rows)) {
    for (const RowIndex s : indices(r + 1)) {
      Real sum(0.0);
      for (const VelocityIndex k : support_of_row(m, r)) {
        sum = madd(y(r, k) * w.inverse_pivot[k], y(s, k), sum);
      }
      w.schur(r, s) = sum;
    }
  }
}

// Factor of A; true in the lanes whose rows are clearly independent, others hold no factor. Rows of
// one unit are judged by A itself. Among translations and rotations the size of a diagonal says
// nothing of another: there every pivot of A stands beside its own diagonal, so that the factor is
// exact to some digits, and independence is a matter of J alone (clear_rows.h).
template <class Real>
inline auto factorize_schur(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  Real* a = w.schur.data();
  if (!has_rows_of_two_units(m)) {
    auto clear = Real(0.0) == Real(1.0);
    with_row_count(m, [&](auto nc) {
      sum_schur_complement(m, w);
      clear = factorize_definite(nc, Real(kClearPivot), a, w.row_inverse.data());
    });
    return clear;
  }
  sum_schur_complement(m, w);
  const auto own = [&w](int number) {
    const RowIndex r(number);
    return Real(kClearPivot) * w.schur(r, r);
  };
  const auto definite = factorize_above(m.cut_row_count(), own, a, w.row_inverse.data());
  return definite && rows_are_clear(m, p, w);
}

template <class Real>
inline void update_schur_complement(const Mechanism& m, const Parameters<Real>& p,
                                    Workspace<Real>& w) {
  const auto clear = factorize_schur(m, p, w);
  w.kept_rows = Real(static_cast<double>(m.cut_row_count()));
  w.redundant = !clear;
  if (!w.rows_may_depend) {
    // Where they do, a trace says nothing.
    lane_bits(clear);
    w.redundant = Real(1.0) < Real(0.0);
  }
  if (any(w.redundant)) factorize_redundant_rows(m, p, w);
}

// schur_rhs := A^-1 schur_rhs
template <class Real>
inline void solve_schur(const Mechanism& m, Workspace<Real>& w) {
  const auto solve = [&] {
    with_row_count(m, [&](auto nc) {
      solve_definite(nc, w.schur.data(), w.row_inverse.data(), w.schur_rhs.data());
    });
  };
  if (any(w.redundant)) {
    solve_beside_redundant_rows(w, solve);
  } else {
    solve();
  }
}

// Y^T D^-1 x for row r
template <class Real>
inline Real project_on_row(const Mechanism& m, const Workspace<Real>& w, RowIndex r,
                           Velocities<const Real> x) {
  const Velocities<const Real> y = w.cut_y.row(r);
  Real sum(0.0);
  for (const VelocityIndex k : support_of_row(m, r))
    sum = madd(y[k] * w.inverse_pivot[k], x[k], sum);
  return sum;
}

// x := x - Y schur_rhs
template <class Real>
inline void subtract_constraint_forces(const Mechanism& m, const Workspace<Real>& w,
                                       Velocities<Real> x) {
  for (const RowIndex r : indices_of(m.cut_rows)) {
    const Velocities<const Real> y = w.cut_y.row(r);
    const Real lambda = w.schur_rhs[r];
    for (const VelocityIndex k : support_of_row(m, r)) x[k] = nmadd(lambda, y[k], x[k]);
  }
}

// What does not depend on forces: closure poses (of those whose rows are all idle, too), rows and
// the factor of A.
template <class Real>
inline void update_cut_joints(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  update_rows<RowStorage::cut>(m, p, w);
  if (m.cut_rows.empty()) return;
  update_constraint_factor(m, p, w);
  update_schur_complement(m, p, w);
}

// bias - s. Couplings are linear: what keeps their rates keeps them.
template <class Real>
inline Real stabilized_bias(const Mechanism& m, const Parameters<Real>& p, RowIndex r,
                            const RowState<Real>& row) {
  if (is_of_coupling(m.cut_rows[r].kind)) return row.bias;
  const ClosureParameters<Real>& n = p.closures[m.cut_rows[r].closure];
  return madd(n.velocity_gain, row.rate, madd(n.position_gain, row.d, row.bias));
}

// Multipliers for L^-T tau in Workspace::y; leaves L^-T (tau - J^T lambda) there.
template <class Real>
inline void solve_cut_joints(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  if (m.cut_rows.empty()) return;
  for (const RowIndex r : indices_of(m.cut_rows)) {
    const RowState<Real>& row = w.cut_rows[r];
    w.schur_rhs[r] = project_on_row(m, w, r, w.y) + stabilized_bias(m, p, r, row);
  }
  solve_schur(m, w);
  for (const RowIndex r : indices_of(m.cut_rows)) w.cut_rows[r].value = w.schur_rhs[r];
  sum_row_forces<RowStorage::cut>(m, w);
  subtract_constraint_forces(m, w, w.y);
}

}  // namespace linkstudy
