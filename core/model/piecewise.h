// Courses over time and forces over a length or coordinate as the step loop has them: a first value
// and segments (core/laws/piecewise_linear.h).
#pragma once

#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

// The course of a load or of an actuator; appends its segments. q: coordinate that it goes
// over, or none.
CourseParameters<double> add_course(const Course& course, PositionIndex q, CourseStructure& s,
                                    Mechanism& m, Parameters<double>& p);

// A force, of which a spring that acts on one side has what is on that side; appends its segments.
CurveParameters<double> add_curve(const ForceCurve& curve, SpringActs acts, CurveStructure& s,
                                  Mechanism& m, Parameters<double>& p);

}  // namespace linkstudy
