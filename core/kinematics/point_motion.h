// Motion of the chosen points of a linkage (Linkage::points). With r from the origin of the body to
// the point, turned into ground axes,
//   p = p_B + r,   v = v_B + omega x r,   a = a_B + g + alpha x r + omega x (omega x r);
// g because accelerations of bodies are kept less gravity. Ground axes; m, m/s, m/s^2.
#pragma once

#include <vector>

#include "core/kinematics/body_accelerations.h"

namespace linkstudy {

// Of a point given in the body's internal frame.
template <class Real>
inline Vec3<Real> point_position(const BodyState<Real>& b, const Vec3<Real>& point) {
  return b.p_WB + b.R_WB * point;
}

template <class Real>
inline Vec3<Real> point_velocity(const BodyState<Real>& b, const Vec3<Real>& point) {
  return b.v_WB + cross(b.w_WB, b.R_WB * point);
}

// `moving` comes from update_body_accelerations.
template <class Real>
inline Vec3<Real> point_acceleration(const BodyState<Real>& moving, const Vec3<Real>& gravity,
                                     const Vec3<Real>& point) {
  const Vec3<Real> r = moving.R_WB * point;
  const Vec3<Real> turning = cross(moving.alpha_WB, r) + cross(moving.w_WB, cross(moving.w_WB, r));
  return moving.a_WB + gravity + turning;
}

struct PointMotion {
  Vec3<double> position;
  Vec3<double> velocity;
  Vec3<double> acceleration;
};

// Of every chosen point, in the order of Mechanism::point_names. q (nq), v (nv), qdd (nv); rates
// need not agree with closures.
std::vector<PointMotion> point_motions(const Mechanism& m, const Parameters<double>& p,
                                       const double* q, const double* v, const double* qdd);

}  // namespace linkstudy
