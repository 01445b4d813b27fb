// Courses of a drive over time and laws of resistance over speed ([Urbas16] fig. 10; curve shapes
// are our assumptions). Values in N or N m.
#pragma once

#include "core/base/elementary.h"
#include "core/laws/piecewise_linear.h"

namespace linkstudy {

// t / T from 0 to 1 and flat outside, with rate = 1 / T
template <class Real>
inline Real ramp_course(Real t, Real rate) {
  return min(max(t * rate, Real(0.0)), Real(1.0));
}

// 3 s^2 - 2 s^3 on [0, 1], 0 before and 1 after
template <class Real>
inline Real smooth_course(Real t, Real rate) {
  const Real s = ramp_course(t, rate);
  return s * s * madd(Real(-2.0), s, Real(3.0));
}

// x moved by whole periods into the one that begins at `origin`. What reaches the end of a period
// but for rounding begins the next, so that a jump there does not depend on how x was summed up.
template <class Real>
inline Real within_period(Real x, Real origin, Real period) {
  const Real round(detail::kRound), rounding(1.0e-14);
  const Real way = x - origin;
  const Real periods = way / period;
  const Real reached = madd(abs(periods), rounding, periods);
  const Real nearest = (reached + round) - round;
  const Real whole = nearest - select(nearest > reached, Real(1.0), Real(0.0));
  return origin + max(nmadd(whole, period, way), Real(0.0));
}

// t_res = value * (v / v0)
template <class Real>
inline Real linear_resistance(Real v, Real coefficient) {
  return coefficient * v;
}

// t_res = value * (v / v0) |v / v0|, coefficient = value / v0^2
template <class Real>
inline Real quadratic_resistance(Real v, Real coefficient) {
  return coefficient * v * abs(v);
}

}  // namespace linkstudy
