// Functions that are piecewise linear between points and constant beyond the first and the last: a
// first value and a sum of segments, one for each interval. Courses over time (course.h) and forces
// of springs over their length or coordinate are made of them.
#pragma once

#include "core/base/real.h"

namespace linkstudy {

// One segment: slope * clamp(x - begin, 0, length).
template <class Real>
inline Real linear_segment(Real x, Real begin, Real length, Real slope) {
  return slope * min(max(x - begin, Real(0.0)), length);
}

// Its integral over x from anywhere below `begin`.
template <class Real>
inline Real linear_segment_integral(Real x, Real begin, Real length, Real slope) {
  const Real zero(0.0);
  const Real way = x - begin;
  const Real inside = min(max(way, zero), length);
  return slope * madd(Real(0.5) * inside, inside, length * max(way - length, zero));
}

// Its slope at x; at a bend that of what follows.
template <class Real>
inline Real linear_segment_slope(Real x, Real begin, Real length, Real slope) {
  const Real way = x - begin;
  return select(way >= Real(0.0) && way < length, slope, Real(0.0));
}

}  // namespace linkstudy
