// Accelerations do not depend on how a linkage lies in space, redundant closure equations included:
// rows that vanish in one orientation are only small by rounding in another.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/mechanisms/four_bar.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing {
namespace {

void turn_end(const Eigen::Matrix3d& r, ClosureEnd& end) {
  if (end.link != kGround) return;
  end.frame.rotation = r * end.frame.rotation;
  end.frame.position = r * end.frame.position;
}

Linkage turned(Linkage linkage, const Eigen::Matrix3d& r) {
  linkage.gravity = r * linkage.gravity;
  for (Joint& joint : linkage.joints) {
    if (joint.parent != kGround) continue;
    joint.frame.rotation = r * joint.frame.rotation;
    joint.frame.position = r * joint.frame.position;
  }
  for (Closure& closure : linkage.closures) {
    turn_end(r, closure.first);
    turn_end(r, closure.second);
  }
  return linkage;
}

}  // namespace

TEST(Orientation, A_redundant_four_bar_accelerates_alike_however_it_lies) {
  const Linkage upright = four_bar();
  const Eigen::VectorXd expected = EngineProbe(upright, 0.0).qdd();
  for (const double angle : {0.3, 0.7, 1.1, 2.0}) {
    const Eigen::Matrix3d r = (Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()))
                                  .toRotationMatrix();
    const Eigen::VectorXd qdd = EngineProbe(turned(upright, r), 0.0).qdd();
    // Redundant directions are solved in squared condition: 1e-9 leaves room for that.
    EXPECT_LT((qdd - expected).norm(), 1e-9 * (1.0 + expected.norm())) << angle;
  }
}

}  // namespace linkstudy::testing
