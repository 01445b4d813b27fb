// Force of a spring and the damper beside it over a length or coordinate x, N or N m, positive
// where it acts against growing x (in tension). With the elastic force f_e(x) and the damping b,
//   both         f = f_e + b x'
//   tension      f = max(f_e + b x', 0) where the spring is stretched, else 0; there f_e >= 0
//   compression  f = min(f_e + b x', 0) where it is compressed, else 0; there f_e <= 0
// so that a rope never pushes, also while its damper lets it go slack. Stored: the integral of f_e;
// dissipated: (f - f_e) x', which is never below zero.
// f_e is linear, k (x - x_0), or piecewise linear through given points and constant beyond them.
#pragma once

#include "core/base/real.h"
#include "core/laws/spring_acts.h"

namespace linkstudy {

// What acts of x, which is above zero in tension: all, or its part on one side.
template <class Real>
inline Real acting_part(SpringActs acts, Real x) {
  const Real zero(0.0);
  return acts == SpringActs::both ? x : acts == SpringActs::tension ? max(x, zero) : min(x, zero);
}

// True where a spring that is stretched by `stretch`, or has an elastic force of this sign, acts.
template <class Real>
inline auto is_acting(SpringActs acts, Real stretch) {
  const Real zero(0.0);
  return acts == SpringActs::both      ? zero == zero
         : acts == SpringActs::tension ? stretch > zero
                                       : stretch < zero;
}

// f of a spring with the elastic force f_e and the damping force b x'.
template <class Real>
inline Real spring_force(SpringActs acts, Real elastic, Real damping, Real stretch) {
  const Real whole = elastic + damping;
  if (acts == SpringActs::both) return whole;
  return select(is_acting(acts, stretch), acting_part(acts, whole), Real(0.0));
}

}  // namespace linkstudy
