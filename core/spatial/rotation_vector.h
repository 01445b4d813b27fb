// Rotation vector phi of the turn R = R_W1^T R_W2 between two frames: R = exp([phi]), seen in frame
// 1 (and in frame 2 alike), rad, 0 <= |phi| <= pi. By the unit quaternion of R with its largest
// entry taken from the diagonal, and |phi| = 2 atan2(|vector part|, |scalar part|): no loss at
// small turns and none near pi, where phi leaps to -phi. Rate: phi_dot = T omega with omega the
// angular velocity of frame 2 in frame 1 and
//   T^T = E + 1/2 [phi] + (1 - h cot h) [n]^2,   h = |phi| / 2,  n = phi / |phi|
// (Bullo and Murray, Proportional derivative control on the Euclidean group, 1995, the
// derivative of the logarithm on SO(3)). phi . phi_dot = phi . omega, so k phi is the moment of the
// energy k/2 |phi|^2.
#pragma once

#include "core/base/elementary.h"
#include "core/spatial/vector3.h"

namespace linkstudy {

template <class Real>
struct RotationVector {
  Vec3<Real> phi;   // rad
  Vec3<Real> axis;  // n; zero without a turn
  Real excess;      // 1 - h cot h, from 0 to 1
};

namespace detail {

// A quaternion of R, not of unit length: scalar w and vector v.
template <class Real>
struct LooseQuaternion {
  Real w;
  Vec3<Real> v;
};

template <class Real>
inline LooseQuaternion<Real> choose(typename RealTraits<Real>::Mask mask,
                                    const LooseQuaternion<Real>& a,
                                    const LooseQuaternion<Real>& b) {
  return {select(mask, a.w, b.w),
          {select(mask, a.v.x, b.v.x), select(mask, a.v.y, b.v.y), select(mask, a.v.z, b.v.z)}};
}

template <class Real>
inline LooseQuaternion<Real> loose_quaternion(const Mat3<Real>& r1, const Mat3<Real>& r2) {
  const Vec3<Real> x = transpose_times(r1, r2.x);  // columns of R
  const Vec3<Real> y = transpose_times(r1, r2.y);
  const Vec3<Real> z = transpose_times(r1, r2.z);
  const Real one(1.0);
  const Vec3<Real> odd = {y.z - z.y, z.x - x.z, x.y - y.x};
  const Real xy = x.y + y.x, xz = x.z + z.x, yz = y.z + z.y;
  const Real by_w = one + x.x + y.y + z.z, by_x = one + x.x - y.y - z.z;
  const Real by_y = one - x.x + y.y - z.z, by_z = one - x.x - y.y + z.z;
  LooseQuaternion<Real> q{by_w, odd};
  Real largest = by_w;
  const auto take = [&](Real square, const LooseQuaternion<Real>& other) {
    q = choose<Real>(square > largest, other, q);
    largest = max(largest, square);
  };
  take(by_x, {odd.x, {by_x, xy, xz}});
  take(by_y, {odd.y, {xy, by_y, yz}});
  take(by_z, {odd.z, {xz, yz, by_z}});
  return q;
}

}  // namespace detail

template <class Real>
inline RotationVector<Real> rotation_vector(const Mat3<Real>& r1, const Mat3<Real>& r2) {
  const detail::LooseQuaternion<Real> q = detail::loose_quaternion(r1, r2);
  const Real zero(0.0), one(1.0);
  const Real square = dot(q.v, q.v);
  const auto still = square < Real(1e-290);  // turns below 1e-145 rad
  const Real sine = sqrt(square), cosine = abs(q.w);
  const Real half = quadrant_angle(sine, cosine);
  const Real sign = select(q.w < zero, Real(-1.0), one);
  const Real inverse = select(still, zero, sign / select(still, one, sine));
  const Vec3<Real> axis = inverse * q.v;
  const Real excess = one - select(still, one, half * cosine / select(still, one, sine));
  return {(Real(2.0) * half) * axis, axis, excess};
}

// Row i of T in frame 1: d(phi_i) / d(turn of frame 2).
template <class Real>
inline Vec3<Real> rotation_vector_gradient(const RotationVector<Real>& r, const Vec3<Real>& e) {
  const Vec3<Real> bent = cross(r.axis, cross(r.axis, e));
  return madd(r.excess, bent, madd(Real(0.5), cross(r.phi, e), e));
}

}  // namespace linkstudy
