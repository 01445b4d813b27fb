// What a user is told before a run, and what not.
#include "core/simulation/prepare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::prepare_test {
namespace {

// The revolute joint replaced, its second frame turned about the pin by some degrees.
Linkage turned_revolute(double degrees) {
  Linkage linkage = rsrrp_revolute();
  Closure& pin = linkage.closures[0];
  pin.model = ClosureModel::sde;
  pin.sde.tilt = TiltMeasure::linearized;
  pin.second.frame.rotation *=
      Eigen::AngleAxisd(degrees * M_PI / 180, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return linkage;
}

std::string warning_about(const std::string& what, const Linkage& linkage) {
  const Preparation p = prepare(linkage, steps_of(1e-5, 0.01));
  EXPECT_EQ(p.cause, Cause::ok) << p.message;
  const auto found = std::find_if(p.warnings.begin(), p.warnings.end(), [&](const auto& text) {
    return text.find(what) != std::string::npos;
  });
  return found == p.warnings.end() ? "" : *found;
}

}  // namespace

TEST(Prepare, Warns_of_a_linearized_tilt_where_the_joint_is_turned_beyond_45_degrees) {
  for (const double degrees : {0.0, 30.0, -44.0}) {
    EXPECT_EQ(warning_about("linearized", turned_revolute(degrees)), "") << degrees;
  }
  for (const double degrees : {46.0, -90.0, 170.0}) {
    const std::string text = warning_about("linearized", turned_revolute(degrees));
    const std::string angle = std::to_string(static_cast<int>(std::abs(degrees)));
    EXPECT_NE(text.find("closure 'R': its ends are turned by " + angle + " deg"), std::string::npos)
        << text;
  }
  Linkage exact = turned_revolute(90.0);
  exact.closures[0].sde.tilt = TiltMeasure::axis;
  EXPECT_EQ(warning_about("linearized", exact), "");
}

TEST(Prepare, Warns_of_a_given_velocity_that_the_closures_do_not_leave) {
  Linkage right = four_bar();
  EXPECT_EQ(warning_about("initial velocity", right), "");
  Linkage wrong = right;
  wrong.joints[1].velocity = {2.0 * wrong.joints[1].velocity.at(0)};
  EXPECT_THAT(warning_about("initial velocity", wrong),
              ::testing::HasSubstr("instead of the given 5, so that the closures stay shut"));
  for (Joint& joint : wrong.joints) joint.velocity.clear();  // a proposal of nothing
  EXPECT_EQ(warning_about("initial velocity", wrong), "");
}

TEST(Prepare, Joints_that_hold_a_motion_twice_are_named) {
  const Preparation p = prepare(four_bar(), steps_of(1e-3, 1.0));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_THAT(p.warnings, ::testing::Contains(::testing::AllOf(
                              ::testing::HasSubstr("3 of 5 closure equations are redundant"),
                              ::testing::HasSubstr("joint.A"), ::testing::HasSubstr("closure.C"))));
}

// A parallelogram stretched out: there the coupler may fold either way.
TEST(Prepare, A_start_at_a_singular_position_is_told_from_redundant_joints) {
  Linkage linkage = four_bar({.crank = 0.1, .coupler = 0.4, .rocker = 0.1, .ground = 0.4});
  for (Joint& joint : linkage.joints) {
    joint.position = {0.0};
    joint.velocity = {0.0};
  }
  const Preparation p = prepare(linkage, steps_of(1e-3, 1.0));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_THAT(p.warnings, ::testing::Contains(
                              ::testing::HasSubstr("the start is a singular position: 1 of 5")));
}

}  // namespace linkstudy::testing::prepare_test
