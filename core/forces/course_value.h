// The value of a course at a time.
#pragma once

#include "core/laws/course.h"
#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

// Amplitude at time t of a load or an actuator, N or N m.
template <class Structure, class Numbers, class Real>
inline Real course_value(const Structure& s, const Numbers& n,
                         const SegmentParameters<Real>* segments, Real t) {
  switch (s.course) {
    case CourseShape::constant:
      return n.value;
    case CourseShape::ramp:
      return n.value * ramp_course(t, n.rate);
    case CourseShape::smooth:
      return n.value * smooth_course(t, n.rate);
    case CourseShape::table:
      break;
  }
  Real value = n.value;
  for (int i = s.table_begin; i < s.table_end; ++i) {
    const SegmentParameters<Real>& g = segments[i];
    value = value + linear_segment(t, g.begin, g.length, g.slope);
  }
  return value;
}

}  // namespace linkstudy
