// Cut joints closed by multipliers ([Urbas16] eq. (18.3)):
//   M qdd + J^T lambda = tau,   J qdd + bias = s,
// s = 0, or -2 alpha Phi_dot - beta^2 Phi with Baumgarte's stabilisation ([AugUrb18] eq. (9)).
// With M = L^T D L and Y = L^-T J^T the Schur complement is A = Y^T D^-1 Y, and
//   A lambda = Y^T D^-1 (L^-T tau) + bias - s.
// lambda_r is the closure force of row r on chain 1 (N or N m). Redundant rows get the multipliers
// of least norm; Workspace::kept tells them.
#pragma once

#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/branch_sparse.h"
#include "core/numerics/semidefinite.h"

namespace linkstudy {

// A row is dependent when its pivot in J M^-1 J^T falls below this part of its diagonal: rows that
// differ by less than 1e-5 in direction.
inline constexpr double kDependentRow = 1e-10;

// Rows of J for the three ground axes at once: the velocity of the point by each velocity.
template <class Real>
inline void add_point_rates(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                            int last, const Vec3<Real>& point, Real sign, Real* j) {
  for (int k = last; k >= 0; k = m.v_parent[static_cast<std::size_t>(k)]) {
    const auto i = static_cast<std::size_t>(k);
    Vec3<Real> e = w.axes[i];
    if (m.v_rotates[i]) {
      const Vec3<Real> turned = cross(e, point - w.bodies[static_cast<std::size_t>(m.v_body[i])].p);
      e = m.v_screw[i] < 0 ? turned
                           : madd(p.pitch[static_cast<std::size_t>(m.v_screw[i])], e, turned);
    }
    j[k] = madd(sign, e.x, j[k]);
    j[m.nv + k] = madd(sign, e.y, j[m.nv + k]);
    j[2 * m.nv + k] = madd(sign, e.z, j[2 * m.nv + k]);
  }
}

// Y = L^-T J^T by rows.
template <class Real>
inline void update_constraint_factor(const Mechanism& m, const Parameters<Real>& p,
                                     Workspace<Real>& w) {
  const Real* h = w.mass.data();
  const int nv = m.nv;
  for (std::size_t i = 0; i < m.closures.size(); ++i) {
    const ClosureStructure& c = m.closures[i];
    if (c.model != ClosureModel::cut) continue;
    Real* y = w.cut_y.data() + c.row_begin * nv;
    for (int r = c.row_begin; r < c.row_end; ++r) {
      for (int k : c.support) y[(r - c.row_begin) * nv + k] = Real(0.0);
    }
    int r = c.row_begin;
    if (c.point_rows) {
      add_point_rates(m, p, w, c.last_1, w.closures[i].p1, Real(-1.0), y);
      add_point_rates(m, p, w, c.last_2, w.closures[i].p2, Real(1.0), y);
      r += 3;
    }
    for (; r < c.row_end; ++r) {
      const auto row = static_cast<std::size_t>(r);
      add_row_rates(m, p, w, m.cut_rows[row], w.cut_rows[row], w.cut_y.data() + r * nv);
    }
    const int rows = c.row_end - c.row_begin;
    for (int k : c.support) {
      for (int a = m.v_parent[static_cast<std::size_t>(k)]; a >= 0;
           a = m.v_parent[static_cast<std::size_t>(a)]) {
        const Real l = -h[k * nv + a];
        for (int n = 0; n < rows; ++n) y[n * nv + a] = madd(l, y[n * nv + k], y[n * nv + a]);
      }
    }
  }
}

// A = Y^T D^-1 Y and its factor.
template <class Real>
inline void update_schur_complement(const Mechanism& m, Workspace<Real>& w) {
  const int nc = m.cut_row_count();
  const int nv = m.nv;
  for (int r = 0; r < nc; ++r) {
    const Row& row = m.cut_rows[static_cast<std::size_t>(r)];
    const ClosureStructure& c = m.closures[static_cast<std::size_t>(row.closure)];
    const Real* y = w.cut_y.data() + r * nv;
    for (int s = 0; s <= r; ++s) {
      const Real* z = w.cut_y.data() + s * nv;
      Real sum(0.0);
      for (int k : c.support) {
        sum = madd(y[k] * w.inverse_pivot[static_cast<std::size_t>(k)], z[k], sum);
      }
      w.schur[static_cast<std::size_t>(r * nc + s)] = sum;
    }
  }
  w.redundant = factorize_semidefinite(nc, Real(kDependentRow), w.schur.data(), w.kept.data());
}

// schur_rhs := A^-1 schur_rhs
template <class Real>
inline void solve_schur(const Mechanism& m, Workspace<Real>& w) {
  const int nc = m.cut_row_count();
  if (w.redundant) {
    solve_least_norm(nc, w.schur.data(), w.kept.data(), w.gram.data(), w.scratch.data(),
                     w.schur_rhs.data());
  } else {
    solve_cholesky(nc, w.schur.data(), w.schur_rhs.data());
  }
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
    for (int k : c.support) x[k] = madd(Real(-lambda), y[k], x[k]);
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
