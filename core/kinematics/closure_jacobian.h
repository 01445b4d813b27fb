// Jacobian of closure rows, J_rk = d(d_r)/d(q_k) in velocity coordinates: the power of the row's
// unit wrench on the motion of the second body less that on the first.
#pragma once

#include <Eigen/Core>

#include "core/kinematics/closure_kinematics.h"

namespace linkstudy {

// Rate of a row's d by velocity k, for a unit wrench with its force at `point`.
template <class Real>
inline Real row_rate(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w, int k,
                     const Vec3<Real>& point, const RowState<Real>& row) {
  const auto i = static_cast<std::size_t>(k);
  const Vec3<Real>& e = w.axes[i];
  if (!m.v_rotates[i]) return dot(e, row.force);
  const Vec3<Real> arm = point - w.bodies[static_cast<std::size_t>(m.v_body[i])].p;
  const Real turned = dot(e, cross(arm, row.force) + row.couple);
  if (m.v_screw[i] < 0) return turned;
  return madd(p.pitch[static_cast<std::size_t>(m.v_screw[i])], dot(e, row.force), turned);
}

// Row r of J: the rates by the velocities on the path of the second body, less those of the first.
template <class Real>
inline void add_row_rates(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                          const Row& r, const RowState<Real>& row, Real* j) {
  const auto closure = static_cast<std::size_t>(r.closure);
  const ClosureStructure& c = m.closures[closure];
  const ClosureState<Real>& x = w.closures[closure];
  const Vec3<Real>& point_1 = acts_at_both_points(r.kind) ? x.p1 : x.p2;
  for (int k = c.last_1; k >= 0; k = m.v_parent[static_cast<std::size_t>(k)]) {
    j[k] = j[k] - row_rate(m, p, w, k, point_1, row);
  }
  for (int k = c.last_2; k >= 0; k = m.v_parent[static_cast<std::size_t>(k)]) {
    j[k] = j[k] + row_rate(m, p, w, k, x.p2, row);
  }
}

// J (rows, nv) of rows whose states a workspace holds.
Eigen::MatrixXd row_jacobian(const Mechanism& m, const Parameters<double>& p,
                             const Workspace<double>& w, const std::vector<Row>& rows,
                             const std::vector<RowState<double>>& states);

}  // namespace linkstudy
