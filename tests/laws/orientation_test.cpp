// Accelerations do not depend on how a linkage lies in space, redundant closure equations included:
// rows that vanish in one orientation are only small by rounding in another.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::orientation_test {
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
    EXPECT_LT((qdd - expected).norm(), 1e-12 * (1.0 + expected.norm())) << angle;
  }
}

// The least norm takes no side: translations of a closure weigh alike.
TEST(Orientation, Redundant_multipliers_turn_with_the_linkage) {
  const Eigen::Matrix3d r =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  for (const Linkage& upright : {four_bar(), bennett()}) {
    EngineProbe before(upright, 0.0), after(turned(upright, r), 0.0);
    for (const char* group : {"closure.C.force", "closure.C.torque"}) {
      const Eigen::Vector3d expected = r * before.vector(group);
      EXPECT_LT((after.vector(group) - expected).norm(), 1e-11 * (1.0 + expected.norm()))
          << upright.name << " " << group;
    }
  }
}

}  // namespace linkstudy::testing::orientation_test
