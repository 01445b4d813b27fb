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
                          int closure, const Row& r, const RowState<Real>& row, Real* j) {
  const ClosureState<Real>& x = at(w.closures, closure);
  const Vec3<Real>& point_1 = acts_at_both_points(r.kind) ? x.p1 : x.p2;
  const auto rate = [&](auto k, const Vec3<Real>& point) {
    const Velocity& v = at(m.velocities, k);
    return row_rate(v, p.pitch.data(), at(w.axes, k), at(w.bodies, v.body).p, point, row);
  };
  for (const int k : path(m, at(m.closures, closure).last_1)) j[k] = j[k] - rate(k, point_1);
  for (const int k : path(m, at(m.closures, closure).last_2)) j[k] = j[k] + rate(k, x.p2);
}

// Velocity of a point by a velocity of its path, ground axes.
template <class Real>
inline Vec3<Real> point_rate(const Mechanism& m, const Parameters<Real>& p,
                             const Workspace<Real>& w, int k, const Vec3<Real>& point) {
  const Velocity& v = at(m.velocities, k);
  const Vec3<Real>& e = at(w.axes, k);
  if (v.kind == VelocityKind::translation) return e;
  const Vec3<Real> turned = cross(e, point - at(w.bodies, v.body).p);
  return v.kind == VelocityKind::screw ? madd(at(p.pitch, v.stage), e, turned) : turned;
}

// Rows of J for the three ground axes at once; row n of J starts at j + n nv.
template <class Real>
inline void add_point_rates(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                            int closure, Real* j) {
  const int nv = m.nv;
  const ClosureState<Real>& x = at(w.closures, closure);
  for (const int k : path(m, at(m.closures, closure).last_1)) {
    const Vec3<Real> e = point_rate(m, p, w, k, x.p1);
    j[k] = j[k] - e.x;
    j[nv + k] = j[nv + k] - e.y;
    j[2 * nv + k] = j[2 * nv + k] - e.z;
  }
  for (const int k : path(m, at(m.closures, closure).last_2)) {
    const Vec3<Real> e = point_rate(m, p, w, k, x.p2);
    j[k] = j[k] + e.x;
    j[nv + k] = j[nv + k] + e.y;
    j[2 * nv + k] = j[2 * nv + k] + e.z;
  }
}

// Row of J of a coupling.
template <class Real>
inline void add_coupling_rates(const Mechanism& m, const Parameters<Real>& p, int coupling,
                               Real* j) {
  for (const int n : terms_of(at(m.couplings, coupling))) {
    Real& rate = j[at(m.coupling_terms, n).v];
    rate = rate + at(p.coupling_factors, n);
  }
}

// Angular velocity and velocity of a point (6) by a velocity of its path, ground axes.
Eigen::Matrix<double, 6, 1> twist_of(const Mechanism& m, const Parameters<double>& p,
                                     const Workspace<double>& w, int k,
                                     const Eigen::Vector3d& point);

// J (rows, nv) of rows whose states a workspace holds.
Eigen::MatrixXd row_jacobian(const Mechanism& m, const Parameters<double>& p,
                             const Workspace<double>& w, const std::vector<Row>& rows,
                             const std::vector<RowState<double>>& states);

}  // namespace linkstudy
