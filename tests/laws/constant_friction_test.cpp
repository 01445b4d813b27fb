// Friction of joints under a constant load: bodies that slide or turn freely are slowed evenly
// along the way they go, as Coulomb's law says (mu_s = mu_k, no viscous part, bristles so stiff
// that they bend by 1e-5 m).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/simulation/prepare.h"
#include "core/topology/check_linkage.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::constant_friction_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMu = 0.3, kRadius = 0.02, kPreload = 50.0, kMass = 1.5, kInertia = 0.004;

JointFriction braked() {
  JointFriction friction;
  friction.law = {.mu_s = kMu, .mu_k = kMu, .v_s = 0.01, .sigma0 = 3.0e4, .sigma1 = 30.0};
  friction.load = FrictionLoad::constant;
  friction.radius = kRadius;
  friction.preload = kPreload;
  return friction;
}

Linkage free_body(JointType type, const std::vector<double>& velocity) {
  Linkage linkage;
  linkage.name = "braked";
  linkage.gravity = Vector3d::Zero();
  linkage.links = {{"body", kMass, Vector3d::Zero(), kInertia * Matrix3d::Identity(), {}}};
  Joint joint = joint_at("J", type, kGround, "body", {});
  joint.velocity = velocity;
  joint.friction = braked();
  if (type == JointType::prismatic) joint.friction->radius = 0.0;
  if (type == JointType::screw) joint.pitch = 0.01;
  linkage.joints = {joint};
  return linkage;
}

Linkage free_ball(const std::vector<double>& velocity, RotationCoordinates coordinates) {
  Linkage linkage = free_body(JointType::spherical, velocity);
  linkage.joints[0].coordinates = coordinates;
  return linkage;
}

// Begins as runs do, with bristles of steady sliding.
Samples run_of(const Linkage& linkage, double time, const std::vector<std::string>& names) {
  const SimulationOptions options = steps_of(1e-6, time);
  return run(prepare(linkage, options).model, options, names);
}

// The rates after `time`.
Eigen::VectorXd rates_after(const Linkage& linkage, double time) {
  std::vector<std::string> names;
  const int nv = velocity_count(linkage.joints[0].type);
  for (int k = 0; k < nv; ++k) {
    names.push_back("joint.J.v" + (nv == 1 ? "" : "." + std::to_string(k)));
  }
  names.push_back("energy.residual");
  const Samples s = run_of(linkage, time, names);
  EXPECT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  const Eigen::VectorXd last = s.values.row(s.values.rows() - 1);
  EXPECT_NEAR(last[nv], 0.0, 1e-9) << "the energy ledger";
  return last.head(nv);
}

constexpr double kTurning = kMu * kPreload * kRadius / kInertia;  // rad/s^2
constexpr double kSliding = kMu * kPreload / kMass;               // m/s^2
constexpr double kTime = 0.02;                                    // s
// Bristles begin bent as in steady sliding; what is left is their lag.
constexpr double kLag = 1e-6;

}  // namespace

TEST(ConstantFriction, Slows_single_coordinates_evenly) {
  EXPECT_NEAR(rates_after(free_body(JointType::revolute, {9}), kTime)[0], 9 - kTurning * kTime,
              kLag);
  EXPECT_NEAR(rates_after(free_body(JointType::prismatic, {-2}), kTime)[0], -2 + kSliding * kTime,
              kLag);
  // A nut carries its mass along: pitch in m/rad.
  const double inertia = kInertia + kMass * 0.01 * 0.01;
  EXPECT_NEAR(rates_after(free_body(JointType::screw, {9}), kTime)[0],
              9 - kTurning * kInertia / inertia * kTime, kLag);
}

// Turn and slide rub as one vector u = (r turn, slide), which turns as they slow unlike: against an
// integration of the law as printed, z' = u - sigma0 |u| z / mu, force (sigma0 z + sigma1 z') N.
TEST(ConstantFriction, Of_a_cylinder_acts_along_its_helix) {
  using State = Eigen::Matrix<double, 4, 1>;  // turn, slide, z
  const Friction law = braked().law;
  const auto slope = [&](const State& x) {
    const Eigen::Vector2d u(kRadius * x[0], x[1]), z = x.tail<2>();
    const Eigen::Vector2d bends = u - law.sigma0 * u.norm() / kMu * z;
    const Eigen::Vector2d force = kPreload * (law.sigma0 * z + law.sigma1 * bends);
    State rate;
    rate << -force[0] * kRadius / kInertia, -force[1] / kMass, bends;
    return rate;
  };
  State x(9, 0.4, 0, 0);
  const Eigen::Vector2d u(kRadius * x[0], x[1]);
  x.tail<2>() = kMu / law.sigma0 * u.normalized();
  const int steps = 40000;
  const double h = kTime / steps;
  for (int i = 0; i < steps; ++i) {  // Heun
    const State first = slope(x);
    x += h / 2 * (first + slope(x + h * first));
  }
  const Eigen::VectorXd v = rates_after(free_body(JointType::cylindrical, {9, 0.4}), kTime);
  EXPECT_NEAR(v[0], x[0], 1e-6);
  EXPECT_NEAR(v[1], x[1], 1e-6);
  EXPECT_LT(v[0], 8.5);
}

TEST(ConstantFriction, Slows_a_puck_along_its_way_and_its_spin) {
  const Eigen::VectorXd v = rates_after(free_body(JointType::planar, {3, -4, 9}), kTime);
  const double left = 1 - kSliding * kTime / 5;
  EXPECT_NEAR(v[0], 3 * left, kLag);
  EXPECT_NEAR(v[1], -4 * left, kLag);
  EXPECT_NEAR(v[2], 9 - kTurning * kTime, kLag);
}

// A body of equal inertias keeps the axis of its turn.
TEST(ConstantFriction, Slows_a_ball_alike_about_all_axes) {
  const Vector3d omega(6, -2, 3);  // 7 rad/s, child axes
  const double left = 1 - kTurning * kTime / 7;
  const Eigen::VectorXd v = rates_after(
      free_ball({omega[0], omega[1], omega[2]}, RotationCoordinates::quaternion), kTime);
  EXPECT_TRUE(near_absolute(v, left * omega, kLag));
  // With three angles, from psi = theta = phi = 0: psi' = w_z, theta' = w_y, phi' = w_x.
  Linkage angles = free_ball({omega[2], omega[1], omega[0]}, RotationCoordinates::zyx);
  const Samples s = run_of(angles, kTime,
                           {"energy.kinetic", "joint.J.friction.0", "joint.J.friction.1",
                            "joint.J.friction.2", "joint.J.q.2"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  const Eigen::VectorXd last = s.values.row(s.values.rows() - 1);
  EXPECT_NEAR(last[0], kInertia / 2 * std::pow(7 * left, 2), 1e-7);
  const Vector3d moment = kMu * kPreload * kRadius * omega / 7;
  EXPECT_TRUE(near_absolute(last.segment(1, 3), moment, 1e-6 * moment.norm()));
  EXPECT_GT(std::abs(last[4]), 0.05) << "it has turned";
}

TEST(ConstantFriction, Slows_a_free_body_in_all_it_does) {
  Linkage linkage = free_body(JointType::free, {0.6, 0.0, 0.8, 6, -2, 3});
  linkage.joints[0].coordinates = RotationCoordinates::quaternion;
  const Eigen::VectorXd v = rates_after(linkage, kTime);
  const Vector3d way(0.6, 0.0, 0.8), omega(6, -2, 3);
  EXPECT_TRUE(near_absolute(v.head(3), (1 - kSliding * kTime) * way, kLag));
  EXPECT_TRUE(near_absolute(v.tail(3), (1 - kTurning * kTime / 7) * omega, kLag));
}

// Each axis of the cross has its own bearing: moment and rate of each, and their power.
TEST(ConstantFriction, Of_a_universal_joint_is_that_of_two_hinges) {
  Linkage linkage = free_body(JointType::universal, {5, -3});
  const Samples s = run_of(linkage, kTime,
                           {"joint.J.friction.0", "joint.J.friction.1", "energy.dissipated",
                            "joint.J.q.0", "joint.J.q.1", "energy.residual"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  const Eigen::VectorXd last = s.values.row(s.values.rows() - 1);
  const double moment = kMu * kPreload * kRadius;
  EXPECT_NEAR(last[0], moment, 1e-6);
  EXPECT_NEAR(last[1], -moment, 1e-6);
  EXPECT_NEAR(last[2], moment * (std::abs(last[3]) + std::abs(last[4])), 1e-6);
  EXPECT_NEAR(last[5], 0.0, 1e-9);
}

// It holds a pendulum up where its moment is enough.
TEST(ConstantFriction, Holds_what_it_can) {
  Linkage linkage = free_body(JointType::revolute, {0});
  linkage.gravity = {0, -9.81, 0};
  linkage.links[0].center_of_mass = {0.015, 0, 0};  // 0.22 N m, against 0.3 N m
  const Eigen::VectorXd v = rates_after(linkage, 0.1);
  EXPECT_NEAR(v[0], 0.0, 1e-3);  // what is left of its shaking
}

// In all joints of a linkage with a flexible coupler and, cut at R, each kind of closure.
TEST(ConstantFriction, Beside_closures_of_every_kind_and_bending_keeps_the_ledger) {
  for (const ClosureModel model : {ClosureModel::cut, ClosureModel::sde, ClosureModel::clearance}) {
    const bool is_loose = model == ClosureModel::clearance;
    Linkage linkage =
        rsup({.clearance = is_loose ? std::optional(ClearanceKind::planar) : std::nullopt,
              .segments = 2});
    Closure& closure = linkage.closures[0];
    closure.model = model;
    if (model == ClosureModel::sde) {
      closure.sde.axes = SdeAxes::first;
      closure.sde.stiffness = {1e6, 1e6, 1e6, 0, 1e4, 1e4};
      closure.sde.damping = {100, 100, 100, 0, 1, 1};
    }
    int braked_joints = 0;
    for (Joint& joint : linkage.joints) {
      if (joint.elastic) continue;
      joint.friction = braked();
      joint.friction->law.sigma0 = 1e4;
      if (joint.type == JointType::prismatic) joint.friction->radius = 0.0;
      ++braked_joints;
    }
    EXPECT_GE(braked_joints, 4);
    const SimulationOptions options = steps_of(is_loose ? 2e-6 : 1e-5, 0.6, 0.01);
    const Preparation start = prepare(linkage, options);
    ASSERT_EQ(start.cause, Cause::ok) << start.message;
    const Samples s = run(start.model, options,
                          {"energy.residual", "energy.supplied", "energy.dissipated", "joint.A.v"});
    ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
    const double moved = s.values.col(1).maxCoeff() + s.values.col(2).maxCoeff();
    EXPECT_GT(s.values.col(2).maxCoeff(), 0.01);
    EXPECT_LT(s.values.col(0).cwiseAbs().maxCoeff(), 1e-7 * moved) << static_cast<int>(model);
  }
}

TEST(ConstantFriction, Asks_for_what_it_needs) {
  Linkage ball = free_body(JointType::spherical, {});
  ball.joints[0].friction->preload = 0.0;
  ball.joints[0].friction->radius = 0.0;
  ASSERT_EQ(check(ball).size(), 2u);
  EXPECT_EQ(check(ball)[0].path, "joint.J.friction.preload");
  EXPECT_EQ(check(ball)[1].path, "joint.J.friction.radius");
  Linkage slide = free_body(JointType::prismatic, {});
  slide.joints[0].friction->radius = 0.1;
  ASSERT_EQ(check(slide).size(), 1u);
  Linkage by_reaction = free_body(JointType::spherical, {});
  by_reaction.joints[0].friction->load = FrictionLoad::reaction;
  ASSERT_EQ(check(by_reaction).size(), 1u);
  EXPECT_EQ(check(by_reaction)[0].path, "joint.J.friction");
}

}  // namespace linkstudy::testing::constant_friction_test
