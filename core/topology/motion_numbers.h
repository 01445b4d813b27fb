// The law of a motion as numbers (core/laws/prescribed_motion.h).
#pragma once

#include <vector>

#include "core/laws/prescribed_motion.h"
#include "core/topology/linkage.h"

namespace linkstudy {

struct MotionNumbers {
  MotionLaw law = MotionLaw::speed;
  bool rises = false;
  MotionParameters<double> parameters{};
  std::vector<KnotParameters<double>> knots{};  // of a table

  CoordinateMotion<double> at(double t) const;
};

// `start`: where the coordinate is without the motion.
MotionNumbers motion_numbers(const Motion& motion, double start);

}  // namespace linkstudy
