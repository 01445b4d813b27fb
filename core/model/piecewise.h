// Courses over time and forces over a length or coordinate as the step loop has them: a first value
// and segments (core/laws/piecewise_linear.h).
#pragma once

#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

// The numbers of a course besides its segments.
struct CourseNumbers {
  double value = 0.0;  // amplitude, or the first of a table
  double rate = 0.0;   // 1 / duration
};

// The course of a load or of an actuator: shape and table of `s` (LoadStructure,
// PointSpringStructure); appends its segments.
template <class Structure>
CourseNumbers add_course(const Course& course, Structure& s, Mechanism& m, Parameters<double>& p);

// A force, of which a spring that acts on one side has what is on that side; appends its segments.
CurveParameters<double> add_curve(const ForceCurve& curve, SpringActs acts, CurveStructure& s,
                                  Mechanism& m, Parameters<double>& p);

}  // namespace linkstudy
