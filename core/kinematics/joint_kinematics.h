// Motion of one joint: the only switch over kinds of basic motion.
//
// A joint is a sequence of stages. Each turns or shifts the frame reached so far:
//   rotation about e     omega += e v,  alpha += omega x e v          (omega before the stage)
//   translation along e  p += e q,  v_p += omega x e q + e v,
//                        a_p += alpha x e q + omega x (omega x e q) + 2 omega x e v
// with the derivatives for qdd = 0, but for coordinates whose motion is prescribed, of which
// alpha += e a, a_p += e a. A ball turns about the axes of the frame after it with
// omega += R w, alpha += omega_before x R w. Every rotation axis passes through the origin after
// the joint, so that a unit rotation of it is (e, 0) about that origin.
// Basic motions Z1 .. Z6: [Palcak].
#pragma once

#include "core/base/elementary.h"
#include "core/model/workspace.h"

namespace linkstudy {

// A body on its way through the stages of its joint: R_WB, p_WB, w_WB, v_WB, alpha_WB and a_WB of
// `s` are those of the frame reached so far. Entries of w_WB and alpha_WB that cannot differ from
// zero are never written (a new workspace has zeros there).
template <class Real>
struct Moving {
  BodyState<Real>& s;
  bool rotates;  // w_WB may differ from zero so far
  bool gyrates;  // alpha_WB may
};

// a c + b s and b c - a s: two axes turned about the third.
template <class Real>
inline void turn(Vec3<Real>& a, Vec3<Real>& b, Real angle) {
  const SinCos<Real> t = sincos(angle);
  const Vec3<Real> a0 = a;
  a = madd(t.cos, a0, t.sin * b);
  b = msub(t.cos, b, t.sin * a0);
}

// Adds an angular velocity relative to the frame so far.
template <class Real>
inline void spin(Moving<Real>& x, const Vec3<Real>& relative) {
  if (!x.rotates) {
    x.s.w_WB = relative;
    x.rotates = true;
    return;
  }
  const Vec3<Real> turning = cross(x.s.w_WB, relative);
  x.s.alpha_WB = x.gyrates ? x.s.alpha_WB + turning : turning;
  x.gyrates = true;
  x.s.w_WB = x.s.w_WB + relative;
}

// Moves the origin by a vector r of the frame so far that grows at `rate`.
template <class Real>
inline void shift(Moving<Real>& x, const Vec3<Real>& r, const Vec3<Real>& rate) {
  x.s.p_WB = x.s.p_WB + r;
  x.s.v_WB = x.s.v_WB + rate;
  if (!x.rotates) return;
  const Vec3<Real> carried = cross(x.s.w_WB, r);
  x.s.v_WB = x.s.v_WB + carried;
  x.s.a_WB = x.s.a_WB + cross(x.s.w_WB, madd(Real(2.0), rate, carried));
  if (x.gyrates) x.s.a_WB = x.s.a_WB + cross(x.s.alpha_WB, r);
}

template <class Real>
inline void pass_translation(Moving<Real>& x, const Vec3<Real>& e, Real q, Real v,
                             Vec3<Real>& axis) {
  axis = e;
  shift(x, q * e, v * e);
}

// R(w, x, y, z) of a unit quaternion.
template <class Real>
inline Mat3<Real> rotation_of(const Real* h) {
  const Real w = h[0], x = h[1], y = h[2], z = h[3];
  const Real two(2.0), one(1.0);
  return {{one - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y)},
          {two * (x * y - w * z), one - two * (x * x + z * z), two * (y * z + w * x)},
          {two * (x * z + w * y), two * (y * z - w * x), one - two * (x * x + y * y)}};
}

// Passes one stage; writes its axes (1, a ball 3).
template <class Real>
inline void pass_stage(const Stage& stage, Real pitch, const Real* q, const Real* v,
                       Moving<Real>& x, Vec3<Real>* axis) {
  switch (stage.motion) {
    case BasicMotion::rz:
      *axis = x.s.R_WB.z;
      spin(x, *v * x.s.R_WB.z);
      turn(x.s.R_WB.x, x.s.R_WB.y, *q);
      return;
    case BasicMotion::tz:
      return pass_translation(x, x.s.R_WB.z, *q, *v, *axis);
    case BasicMotion::ry:
      *axis = x.s.R_WB.y;
      spin(x, *v * x.s.R_WB.y);
      turn(x.s.R_WB.z, x.s.R_WB.x, *q);
      return;
    case BasicMotion::rx:
      *axis = x.s.R_WB.x;
      spin(x, *v * x.s.R_WB.x);
      turn(x.s.R_WB.y, x.s.R_WB.z, *q);
      return;
    case BasicMotion::tx:
      return pass_translation(x, x.s.R_WB.x, *q, *v, *axis);
    case BasicMotion::ty:
      return pass_translation(x, x.s.R_WB.y, *q, *v, *axis);
    case BasicMotion::screw:
      pass_translation(x, x.s.R_WB.z, pitch * *q, pitch * *v, *axis);
      spin(x, *v * x.s.R_WB.z);
      turn(x.s.R_WB.x, x.s.R_WB.y, *q);
      return;
    case BasicMotion::ball:
      x.s.R_WB = x.s.R_WB * rotation_of(q);
      axis[0] = x.s.R_WB.x;
      axis[1] = x.s.R_WB.y;
      axis[2] = x.s.R_WB.z;
      spin(x, madd(v[0], x.s.R_WB.x, madd(v[1], x.s.R_WB.y, v[2] * x.s.R_WB.z)));
      return;
  }
}

// Adds the acceleration of a stage just passed whose motion is prescribed.
template <class Real>
inline void accelerate(VelocityKind kind, Real pitch, Real qdd, const Vec3<Real>& axis,
                       Moving<Real>& x) {
  const Vec3<Real> added = qdd * axis;
  if (kind != VelocityKind::rotation) {
    x.s.a_WB = x.s.a_WB + (kind == VelocityKind::screw ? pitch * added : added);
  }
  if (kind == VelocityKind::translation) return;
  x.s.alpha_WB = x.gyrates ? x.s.alpha_WB + added : added;
  x.gyrates = true;
}

// Rates of the positions of a stage. Ball: h_dot = 1/2 h o (0, w), w in the child's joint axes.
template <class Real>
inline void position_rates(const Stage& stage, const Real* q, const Real* v, Real* rate) {
  if (stage.motion != BasicMotion::ball) {
    *rate = *v;
    return;
  }
  const Real half(0.5);
  rate[0] = -half * (q[1] * v[0] + q[2] * v[1] + q[3] * v[2]);
  rate[1] = half * (q[0] * v[0] + q[2] * v[2] - q[3] * v[1]);
  rate[2] = half * (q[0] * v[1] + q[3] * v[0] - q[1] * v[2]);
  rate[3] = half * (q[0] * v[2] + q[1] * v[1] - q[2] * v[0]);
}

template <class Real>
inline void normalize_quaternions(const Mechanism& m, Real* q) {
  for (const PositionIndex i : m.ball_q) {
    Real* h = q + i.value();
    const Real square = madd(h[0], h[0], madd(h[1], h[1], madd(h[2], h[2], h[3] * h[3])));
    const Real inverse = Real(1.0) / sqrt(square);
    for (int j = 0; j < 4; ++j) h[j] = h[j] * inverse;
  }
}

// q := q + the displacement dq in velocity coordinates; quaternions are normalised.
template <class Real>
inline void displace(const Mechanism& m, Velocities<const Real> dq, Real* q) {
  for (const Stage& s : m.stages) {
    Real* own = q + s.q.value();
    if (s.motion != BasicMotion::ball) {
      *own = *own + dq[s.v];
      continue;
    }
    Real rate[4];
    position_rates(s, own, &dq[s.v], rate);
    for (int i = 0; i < 4; ++i) own[i] = own[i] + rate[i];
  }
  normalize_quaternions(m, q);
}

}  // namespace linkstudy
