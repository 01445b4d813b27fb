#include "core/topology/motion_numbers.h"

#include <numbers>

#include "core/numerics/natural_spline.h"

namespace linkstudy {
namespace {

MotionParameters<double> parameters_of(const Motion& motion, double start) {
  const double from = motion.from.value_or(start);
  switch (motion.law) {
    case MotionLaw::speed:
      return {from, motion.speed, motion.rise > 0.0 ? 1.0 / motion.rise : 0.0, 0.0};
    case MotionLaw::sine:
      return {from, motion.amplitude, 2.0 * std::numbers::pi * motion.frequency, motion.phase};
    case MotionLaw::table:
      return {};
    default:
      return {from, motion.to - from, 1.0 / motion.duration, 0.0};
  }
}

}  // namespace

MotionNumbers motion_numbers(const Motion& motion, double start) {
  MotionNumbers n{motion.law,
                  motion.law == MotionLaw::speed && motion.rise > 0.0,
                  parameters_of(motion, start),
                  {}};
  if (motion.law != MotionLaw::table) return n;
  for (const SplineKnot& k : natural_spline(motion.times, motion.positions)) {
    n.knots.push_back({k.begin, k.value, k.first, k.second, k.third});
  }
  return n;
}

CoordinateMotion<double> MotionNumbers::at(double t) const {
  return prescribed_motion(law, rises, parameters, knots.data(), static_cast<int>(knots.size()), t);
}

}  // namespace linkstudy
