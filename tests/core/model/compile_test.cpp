// What the compiler may call trivial: shapes follow from the numbers, up to their rounding only.
#include "core/model/compile.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/kinematics/forward_kinematics.h"

namespace linkstudy::testing::compile_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A body that is turned against ground by a constant rotation, and slides along its own z.
Linkage slide(const Matrix3d& rotation) {
  Linkage linkage;
  linkage.links = {{"body", 1.0, Vector3d::Zero(), Matrix3d::Identity()}};
  Joint joint;
  joint.name = "J";
  joint.type = JointType::prismatic;
  joint.parent = kGround;
  joint.child = "body";
  joint.frame.rotation = rotation;
  joint.position = {1.0};
  linkage.joints = {joint};
  return linkage;
}

RotationShape shape_of(const Matrix3d& rotation) {
  return compile(slide(rotation)).mechanism.bodies[BodyIndex(1)].frame;
}

// Where the engine puts the body, and where its axes point.
BodyState<double> place(const Matrix3d& rotation) {
  const Model model = compile(slide(rotation));
  Workspace<double> w = make_workspace<double>(model.mechanism);
  update_kinematics(model.mechanism, model.parameters, model.start.q.data(), model.start.v.data(),
                    w);
  return w.bodies[BodyIndex(1)];
}

Matrix3d turned(double angle, int axis) {
  return Eigen::AngleAxisd(angle, Vector3d::Unit(axis)).toRotationMatrix();
}

}  // namespace

TEST(Compile, A_tilt_below_the_root_of_rounding_is_still_a_tilt) {
  for (const double angle : {1e-7, 1e-8, 1e-9, -1e-10, 1e-13}) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(shape_of(turned(angle, axis)), RotationShape::general) << angle;
    }
    const BodyState<double> tilted = place(turned(angle, 0));
    EXPECT_EQ(tilted.p_WB.y, -std::sin(angle)) << angle;
    EXPECT_EQ(tilted.R_WB.y.z, std::sin(angle)) << angle;
  }
  EXPECT_EQ(shape_of(turned(M_PI / 2, 1) * turned(1e-9, 0)), RotationShape::general);
}

TEST(Compile, Turns_by_right_angles_are_quarter_turns_however_they_are_written) {
  EXPECT_EQ(shape_of(Matrix3d::Identity()), RotationShape::identity);
  EXPECT_EQ(shape_of(turned(2 * M_PI, 2)), RotationShape::identity);  // sin = -2.4e-16
  for (int axis = 0; axis < 3; ++axis) {
    for (const double angle : {M_PI / 2, M_PI, -M_PI / 2, 3 * M_PI / 2}) {
      const Matrix3d r = turned(angle, axis);
      EXPECT_EQ(shape_of(r), RotationShape::quarter) << angle;
      const Eigen::Quaterniond h(r);
      EXPECT_EQ(shape_of(h.toRotationMatrix()), RotationShape::quarter) << angle;
      const Vec3<double> p = place(r).p_WB;  // one metre along the turned z
      EXPECT_NEAR(p.x, r(0, 2), 1e-15);
      EXPECT_NEAR(p.y, r(1, 2), 1e-15);
      EXPECT_NEAR(p.z, r(2, 2), 1e-15);
    }
  }
}

}  // namespace linkstudy::testing::compile_test
