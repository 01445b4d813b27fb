// Prescribed motion of a joint coordinate over time t, with both derivatives:
//   speed           v rises to `reach` over 1 / rate by 3 s^2 - 2 s^3, or has it from the start
//   linear          from + reach t rate, without end
//   smooth          from + reach (3 s^2 - 2 s^3): at rest at both ends, where acceleration jumps
//   polynomial_345  from + reach (10 s^3 - 15 s^4 + 6 s^5): without acceleration at both ends
//   sine            from + reach sin(rate t + phase)
//   table           a natural cubic spline, straight before its first and behind its last knot
// with s = t rate from 0 to 1, at rest before and behind. Units: rad or m, s.
#pragma once

#include "core/base/elementary.h"
#include "core/laws/motion_law.h"

namespace linkstudy {

template <class Real>
struct MotionParameters {
  Real from;   // rad or m; unused by a table
  Real reach;  // rad or m; of a speed rad/s or m/s
  Real rate;   // 1/s: one over the duration, or the rise; of a sine rad/s
  Real phase;  // rad
};

// Of a table, up to the next one (core/numerics/natural_spline.h).
template <class Real>
struct KnotParameters {
  Real begin, value, first, second, third;
};

template <class Real>
struct CoordinateMotion {
  Real q, v, a;  // rad, rad/s, rad/s^2 or m, m/s, m/s^2
};

namespace detail {

template <class Real>
inline CoordinateMotion<Real> move_at_speed(const MotionParameters<Real>& n, bool rises, Real t) {
  if (!rises) return {madd(n.reach, t, n.from), n.reach, Real(0.0)};
  const Real one(1.0);
  const Real s = min(max(t * n.rate, Real(0.0)), one);
  const Real rise = one / n.rate;
  const Real risen = rise * s * s * s * madd(Real(-0.5), s, one);  // times the final speed
  const Real way = risen + max(t - rise, Real(0.0));
  const Real bend = Real(6.0) * s * (one - s);
  return {madd(n.reach, way, n.from), n.reach * s * s * madd(Real(-2.0), s, Real(3.0)),
          n.reach * n.rate * bend};
}

template <class Real>
inline CoordinateMotion<Real> move_smoothly(const MotionParameters<Real>& n, Real t) {
  const Real one(1.0);
  const Real s = min(max(t * n.rate, Real(0.0)), one);
  const Real speed = n.reach * n.rate;
  const Real a = speed * n.rate * madd(Real(-12.0), s, Real(6.0));
  return {madd(n.reach, s * s * madd(Real(-2.0), s, Real(3.0)), n.from),
          speed * Real(6.0) * s * (one - s), select(s < one, a, Real(0.0))};
}

template <class Real>
inline CoordinateMotion<Real> move_by_345(const MotionParameters<Real>& n, Real t) {
  const Real one(1.0);
  const Real s = min(max(t * n.rate, Real(0.0)), one);
  const Real rest = one - s;
  const Real speed = n.reach * n.rate;
  const Real part = madd(s, madd(Real(6.0), s, Real(-15.0)), Real(10.0));
  return {madd(n.reach, s * s * s * part, n.from), speed * Real(30.0) * s * s * rest * rest,
          speed * n.rate * Real(60.0) * s * rest * madd(Real(-2.0), s, one)};
}

template <class Real>
inline CoordinateMotion<Real> swing(const MotionParameters<Real>& n, Real t) {
  const SinCos<Real> x = sincos(madd(n.rate, t, n.phase));
  const Real speed = n.reach * n.rate;
  return {madd(n.reach, x.sin, n.from), speed * x.cos, -(speed * n.rate * x.sin)};
}

template <class Real>
inline CoordinateMotion<Real> move_on_spline(const KnotParameters<Real>* knots, int count, Real t) {
  const Real first = t - knots[0].begin;
  CoordinateMotion<Real> x{madd(knots[0].first, first, knots[0].value), knots[0].first, Real(0.0)};
  for (int i = 0; i < count; ++i) {
    const KnotParameters<Real>& k = knots[i];
    const Real s = t - k.begin;
    const auto reached = s >= Real(0.0);
    const Real bend = madd(s * Real(1.0 / 6.0), k.third, Real(0.5) * k.second);
    x.q = select(reached, madd(s, madd(s, bend, k.first), k.value), x.q);
    x.v = select(reached, madd(s, madd(Real(0.5) * s, k.third, k.second), k.first), x.v);
    x.a = select(reached, madd(s, k.third, k.second), x.a);
  }
  return x;
}

}  // namespace detail

// `rises`: a speed is reached after 1 / rate, else it is there from the start.
template <class Real>
inline CoordinateMotion<Real> prescribed_motion(MotionLaw law, bool rises,
                                                const MotionParameters<Real>& n,
                                                const KnotParameters<Real>* knots, int knot_count,
                                                Real t) {
  switch (law) {
    case MotionLaw::speed:
      return detail::move_at_speed(n, rises, t);
    case MotionLaw::linear:
      return {madd(n.reach, t * n.rate, n.from), n.reach * n.rate, Real(0.0)};
    case MotionLaw::smooth:
      return detail::move_smoothly(n, t);
    case MotionLaw::polynomial_345:
      return detail::move_by_345(n, t);
    case MotionLaw::sine:
      return detail::swing(n, t);
    case MotionLaw::table:
      break;
  }
  return detail::move_on_spline(knots, knot_count, t);
}

}  // namespace linkstudy
