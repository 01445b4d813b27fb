// Motion of one joint: the only switch over kinds of basic motion.
//
// A joint is a sequence of stages. Stage k turns or shifts the frame reached so far and adds its
// unit motion s_k times its velocity. Since s_k moves with the frame before it, the acceleration
// for qdd = 0 grows by V x (s_k v_k), V being the velocity before the stage (after it is the same,
// s_k x s_k = 0). A ball's three unit motions are the axes of the frame after it, and
// V_after x (S w) = V_before x (S w), so the same formula holds.
// Basic motions Z1 .. Z6: [Palcak]; unit motions: [Featherstone, ch. 4].
#pragma once

#include "core/base/elementary.h"
#include "core/model/mechanism.h"
#include "core/spatial/spatial.h"

namespace linkstudy {

// Frame, velocity and qdd-free acceleration while stages are passed.
template <class Real>
struct Moving {
  Mat3<Real> r;
  Vec3<Real> p;
  Motion<Real> v;
  Motion<Real> a;
};

// a c + b s and b c - a s: two axes turned about the third.
template <class Real>
inline void turn(Vec3<Real>& a, Vec3<Real>& b, Real angle) {
  const SinCos<Real> t = sincos(angle);
  const Vec3<Real> a0 = a;
  a = madd(t.cos, a0, t.sin * b);
  b = madd(t.cos, b, Real(-t.sin) * a0);
}

template <class Real>
inline void move_along(Moving<Real>& x, const Motion<Real>& s, Real rate) {
  const Motion<Real> joint = rate * s;
  x.a = x.a + cross(x.v, joint);
  x.v = x.v + joint;
}

template <class Real>
inline void pass_translation(Moving<Real>& x, const Vec3<Real>& e, Real q, Real rate,
                             Motion<Real>& s) {
  s = {zero3<Real>(), e};
  const Vec3<Real> joint = rate * e;
  x.a.linear = x.a.linear + cross(x.v.angular, joint);
  x.v.linear = x.v.linear + joint;
  x.p = madd(q, e, x.p);
}

template <class Real>
inline void pass_rotation(Moving<Real>& x, const Vec3<Real>& e, Real rate, Motion<Real>& s) {
  s = {e, cross(x.p, e)};
  move_along(x, s, rate);
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

template <class Real>
inline void pass_ball(Moving<Real>& x, const Real* q, const Real* v, Motion<Real>* s) {
  x.r = x.r * rotation_of(q);
  s[0] = {x.r.x, cross(x.p, x.r.x)};
  s[1] = {x.r.y, cross(x.p, x.r.y)};
  s[2] = {x.r.z, cross(x.p, x.r.z)};
  const Motion<Real> joint = madd(v[0], s[0], madd(v[1], s[1], v[2] * s[2]));
  x.a = x.a + cross(x.v, joint);
  x.v = x.v + joint;
}

// Passes one stage; writes its unit motions to s (1, a ball 3).
template <class Real>
inline void pass_stage(const Stage& stage, Real pitch, const Real* q, const Real* v,
                       Moving<Real>& x, Motion<Real>* s) {
  switch (stage.motion) {
    case BasicMotion::rz:
      pass_rotation(x, x.r.z, *v, *s);
      turn(x.r.x, x.r.y, *q);
      return;
    case BasicMotion::tz:
      return pass_translation(x, x.r.z, *q, *v, *s);
    case BasicMotion::ry:
      pass_rotation(x, x.r.y, *v, *s);
      turn(x.r.z, x.r.x, *q);
      return;
    case BasicMotion::rx:
      pass_rotation(x, x.r.x, *v, *s);
      turn(x.r.y, x.r.z, *q);
      return;
    case BasicMotion::tx:
      return pass_translation(x, x.r.x, *q, *v, *s);
    case BasicMotion::ty:
      return pass_translation(x, x.r.y, *q, *v, *s);
    case BasicMotion::screw: {
      const Vec3<Real> e = x.r.z;
      *s = {e, madd(pitch, e, cross(x.p, e))};
      move_along(x, *s, *v);
      x.p = madd(pitch * *q, e, x.p);
      turn(x.r.x, x.r.y, *q);
      return;
    }
    case BasicMotion::ball:
      return pass_ball(x, q, v, s);
  }
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
  for (int i : m.ball_q) {
    Real* h = q + i;
    const Real square = madd(h[0], h[0], madd(h[1], h[1], madd(h[2], h[2], h[3] * h[3])));
    const Real inverse = Real(1.0) / sqrt(square);
    for (int j = 0; j < 4; ++j) h[j] = h[j] * inverse;
  }
}

// q := q + the displacement dq in velocity coordinates; quaternions are normalised.
template <class Real>
inline void displace(const Mechanism& m, const Real* dq, Real* q) {
  for (const Stage& s : m.stages) {
    if (s.motion != BasicMotion::ball) {
      q[s.q] = q[s.q] + dq[s.v];
      continue;
    }
    Real rate[4];
    position_rates(s, q + s.q, dq + s.v, rate);
    for (int i = 0; i < 4; ++i) q[s.q + i] = q[s.q + i] + rate[i];
  }
  normalize_quaternions(m, q);
}

}  // namespace linkstudy
