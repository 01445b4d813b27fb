// Jacobian of closure rows, J_rk = d(d_r)/d(q_k) in velocity coordinates: the power of the row's
// unit wrench on the motion of the second body less that on the first.
#pragma once

#include <Eigen/Core>

#include "core/kinematics/closure_kinematics.h"

namespace linkstudy {

// Rate of a row's d by a velocity, for a unit wrench with its force at `point`.
template <class Real>
inline Real row_rate(const Velocity& k, const Real* pitch, const Vec3<Real>& axis,
                     const Vec3<Real>& origin, const Vec3<Real>& point, const RowState<Real>& row) {
  if (k.kind == VelocityKind::translation) return dot(axis, row.force);
  const Real turned = dot(axis, cross(point - origin, row.force) + row.couple);
  if (k.kind == VelocityKind::rotation) return turned;
  return madd(pitch[k.stage], dot(axis, row.force), turned);
}

// Row r of J: the rates by the velocities on the path of the second body, less those of the first.
template <class Real>
inline void add_row_rates(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                          const Row& r, const RowState<Real>& row, Real* j) {
  const auto closure = static_cast<std::size_t>(r.closure);
  const ClosureStructure& c = m.closures[closure];
  const ClosureState<Real>& x = w.closures[closure];
  const Vec3<Real>& point_1 = acts_at_both_points(r.kind) ? x.p1 : x.p2;
  const int* parent = m.v_parent.data();
  const auto rate = [&](int k, const Vec3<Real>& point) {
    const Velocity& v = m.velocities.data()[k];
    return row_rate(v, p.pitch.data(), w.axes.data()[k], w.bodies.data()[v.body].p, point, row);
  };
  for (int k = c.last_1; k >= 0; k = parent[k]) j[k] = j[k] - rate(k, point_1);
  for (int k = c.last_2; k >= 0; k = parent[k]) j[k] = j[k] + rate(k, x.p2);
}

// Rows of J for the three ground axes at once: the velocity of a point by each velocity, with a
// sign; row n of J starts at j + n nv.
template <class Real>
inline void add_point_rates(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                            int last, const Vec3<Real>& point, bool negative, Real* j) {
  const int* parent = m.v_parent.data();
  const int nv = m.nv;
  for (int k = last; k >= 0; k = parent[k]) {
    const Velocity& v = m.velocities.data()[k];
    Vec3<Real> e = w.axes.data()[k];
    if (v.kind != VelocityKind::translation) {
      const Vec3<Real> turned = cross(e, point - w.bodies.data()[v.body].p);
      e = v.kind == VelocityKind::screw ? madd(p.pitch.data()[v.stage], e, turned) : turned;
    }
    if (negative) e = Real(-1.0) * e;
    j[k] = j[k] + e.x;
    j[nv + k] = j[nv + k] + e.y;
    j[2 * nv + k] = j[2 * nv + k] + e.z;
  }
}

// J (rows, nv) of rows whose states a workspace holds.
Eigen::MatrixXd row_jacobian(const Mechanism& m, const Parameters<double>& p,
                             const Workspace<double>& w, const std::vector<Row>& rows,
                             const std::vector<RowState<double>>& states);

}  // namespace linkstudy
