// The value of a course at a time and in a position.
#pragma once

#include "core/forces/force_curve.h"
#include "core/laws/course.h"
#include "core/model/walk.h"
#include "core/model/workspace.h"

namespace linkstudy {

// What a course goes by, within one period where it repeats: s, rad or m.
template <class Real>
inline Real course_argument(const CourseStructure& s, const CourseParameters<Real>& n, Real t,
                            Positions<const Real> q) {
  const Real x = s.q.exists() ? q[s.q] : t;
  return s.repeats ? within_period(x, n.origin, n.period) : x;
}

// Amplitude there of a load or an actuator, N or N m.
template <class Real>
inline Real course_value(const CourseStructure& s, const CourseParameters<Real>& n,
                         const Segments<Real>& segments, Real x) {
  switch (s.shape) {
    case CourseShape::constant:
      return n.value;
    case CourseShape::ramp:
      return n.value * ramp_course(x, n.rate);
    case CourseShape::smooth:
      return n.value * smooth_course(x, n.rate);
    case CourseShape::table:
      break;
  }
  Real value = n.value;
  for (const SegmentIndex i : indices(s.begin, s.end)) {
    const SegmentParameters<Real>& g = segments[i];
    value = value + linear_segment(x, g.begin, g.length, g.slope);
  }
  return value;
}

// The amplitude at time t and q; a table over a coordinate notes how steep it is there.
template <class Real>
inline Real update_course(const CourseStructure& s, const CourseParameters<Real>& n,
                          const Segments<Real>& segments, Real t, Positions<const Real> q,
                          Workspace<Real>& w) {
  const Real x = course_argument(s, n, t, q);
  if (s.bend.exists()) {
    w.spring_weights[s.bend] = abs(curve_slope(CurveStructure{s.begin, s.end}, segments, x));
  }
  return course_value(s, n, segments, x);
}

}  // namespace linkstudy
