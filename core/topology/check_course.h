// Checks of what is piecewise linear or rises over time: courses of loads and actuators (`course`
// of the record), and forces over a length or coordinate. Part of check(Linkage).
#pragma once

#include "core/topology/record_check.h"

namespace linkstudy {

void check_course(const Course& course, RecordCheck& record);

// Keys of the two columns of a curve, such as "force.lengths" and "force.forces".
struct CurveKeys {
  std::string at, force;
};

// Two points at least, increasing.
void check_curve(const ForceCurve& curve, const CurveKeys& keys, RecordCheck& record);

}  // namespace linkstudy
