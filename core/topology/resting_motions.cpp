#include "core/topology/resting_motions.h"

#include <algorithm>

#include "core/topology/motion_numbers.h"

namespace linkstudy {
namespace {

// Where the joint stands without the motion.
double start_of(const Linkage& linkage, const Motion& motion) {
  const auto joint = std::find_if(linkage.joints.begin(), linkage.joints.end(),
                                  [&](const Joint& j) { return j.name == motion.joint; });
  const auto i = static_cast<std::size_t>(motion.coordinate);
  return i < joint->position.size() ? joint->position[i] : 0.0;
}

}  // namespace

Linkage with_resting_motions(Linkage linkage) {
  for (Motion& motion : linkage.motions) {
    const double begin = motion_numbers(motion, start_of(linkage, motion)).at(0.0).q;
    motion.law = MotionLaw::speed;
    motion.from = begin;
    motion.speed = motion.rise = 0.0;
  }
  return linkage;
}

}  // namespace linkstudy
