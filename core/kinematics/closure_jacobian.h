// Jacobian of closure rows, J_rk = d(d_r)/d(q_k) in velocity coordinates: the power of the row's
// unit wrench on the motion of the second body less that on the first.
#pragma once

#include <Eigen/Core>

#include "core/kinematics/closure_kinematics.h"

namespace linkstudy {

// Rate of a row's d by a velocity, for a unit wrench with its force at `point`.
template <class Real>
inline Real row_rate(const Velocity& k, Pitches<Real> pitch, const Vec3<Real>& axis,
                     const Vec3<Real>& origin, const Vec3<Real>& point, const RowState<Real>& row) {
  if (k.kind == VelocityKind::translation) return dot(axis, row.force);
  const Real turned = dot(axis, cross(point - origin, row.force) + row.couple);
  if (k.kind == VelocityKind::rotation) return turned;
  return madd(pitch[k.stage], dot(axis, row.force), turned);
}

// Row r of J: the rates by the velocities on the path of the second body, less those of the first.
template <class Real>
inline void add_row_rates(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                          ClosureIndex closure, const Row& r, const RowState<Real>& row,
                          Velocities<Real> j) {
  const ClosureState<Real>& x = w.closures[closure];
  const Vec3<Real>& point_1 = acts_at_both_points(r.kind) ? x.p_WF : x.p_WS;
  const auto rate = [&](VelocityIndex k, const Vec3<Real>& point) {
    const Velocity& v = m.velocities[k];
    return row_rate(v, p.pitch, w.axes[k], w.bodies[v.body].p_WB, point, row);
  };
  for (const VelocityIndex k : path(m, m.closures[closure].last_1)) j[k] = j[k] - rate(k, point_1);
  for (const VelocityIndex k : path(m, m.closures[closure].last_2)) j[k] = j[k] + rate(k, x.p_WS);
}

// Velocity of a point by a velocity of its path, ground axes.
template <class Real>
inline Vec3<Real> point_rate(const Mechanism& m, const Parameters<Real>& p,
                             const Workspace<Real>& w, VelocityIndex k, const Vec3<Real>& point) {
  const Velocity& v = m.velocities[k];
  const Vec3<Real>& e = w.axes[k];
  if (v.kind == VelocityKind::translation) return e;
  const Vec3<Real> turned = cross(e, point - w.bodies[v.body].p_WB);
  return v.kind == VelocityKind::screw ? madd(p.pitch[v.stage], e, turned) : turned;
}

// Rows of J for the three ground axes at once, x y z in this order.
template <class Real>
inline void add_point_rates(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                            ClosureIndex closure, Velocities<Real> x_row, Velocities<Real> y_row,
                            Velocities<Real> z_row) {
  const ClosureState<Real>& x = w.closures[closure];
  for (const VelocityIndex k : path(m, m.closures[closure].last_1)) {
    const Vec3<Real> e = point_rate(m, p, w, k, x.p_WF);
    x_row[k] = x_row[k] - e.x;
    y_row[k] = y_row[k] - e.y;
    z_row[k] = z_row[k] - e.z;
  }
  for (const VelocityIndex k : path(m, m.closures[closure].last_2)) {
    const Vec3<Real> e = point_rate(m, p, w, k, x.p_WS);
    x_row[k] = x_row[k] + e.x;
    y_row[k] = y_row[k] + e.y;
    z_row[k] = z_row[k] + e.z;
  }
}

// Row of J of a coupling.
template <class Real>
inline void add_coupling_rates(const Mechanism& m, const Parameters<Real>& p,
                               CouplingIndex coupling, Velocities<Real> j) {
  for (const TermIndex n : terms_of(m.couplings[coupling])) {
    Real& rate = j[m.coupling_terms[n].v];
    rate = rate + p.coupling_factors[n];
  }
}

// Angular velocity and velocity of a point (6) by a velocity of its path, ground axes.
Eigen::Matrix<double, 6, 1> twist_of(const Mechanism& m, const Parameters<double>& p,
                                     const Workspace<double>& w, VelocityIndex k,
                                     const Eigen::Vector3d& point);

// J (rows, nv) of rows whose states a workspace holds.
Eigen::MatrixXd row_jacobian(const Mechanism& m, const Parameters<double>& p,
                             const Workspace<double>& w, const IndexedVector<RowIndex, Row>& rows,
                             const IndexedVector<RowIndex, RowState<double>>& states);

}  // namespace linkstudy
