// Friction in tree joints, driven by the joint's own reaction: blocks, wheels and rails whose
// motion is known in closed form.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::joint_friction_test {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;

// Bristles that are stiff, but not for steps of 1e-5 s: sigma0 |v| h / mu stays below 0.1.
JointFriction dry(double mu_s, double mu_k) {
  JointFriction f;
  f.law = {.mu_s = mu_s, .mu_k = mu_k, .v_s = 0.01, .sigma0 = 200.0, .sigma1 = 1.0};
  return f;
}

Linkage one_joint(JointType type, const Link& link, const JointFriction& friction) {
  Linkage linkage;
  linkage.links = {link};
  Joint joint;
  joint.name = "J";
  joint.type = type;
  joint.parent = kGround;
  joint.child = link.name;
  joint.friction = friction;
  linkage.joints = {joint};
  return linkage;
}

Link block(double mass, const Vector3d& center = Vector3d::Zero()) {
  return {"block", mass, center, Vector3d(0.1, 0.1, 0.1).asDiagonal(), {}};
}

// A block on a plane inclined by `angle`: rail along z, plane normal along y.
Linkage on_incline(double angle, const JointFriction& friction) {
  Linkage linkage = one_joint(JointType::prismatic, block(2.0), friction);
  linkage.gravity = {0.0, -kGravity * std::cos(angle), kGravity * std::sin(angle)};
  return linkage;
}

}  // namespace

TEST(Joint_friction, A_block_slides_down_with_the_acceleration_of_coulomb) {
  const double angle = 0.5, mu = 0.2;
  const Samples samples =
      run(compile(on_incline(angle, dry(mu, mu))), steps_of(1e-5, 1.0, 0.5), {"joint.J.v"});
  ASSERT_EQ(samples.outcome.cause, Cause::ok) << samples.outcome.message;
  const double a = kGravity * (std::sin(angle) - mu * std::cos(angle));
  EXPECT_NEAR(samples.values(2, 0) - samples.values(1, 0), 0.5 * a, 1e-8);
}

TEST(Joint_friction, A_block_below_the_angle_of_friction_stays_where_it_is) {
  const double mu = 0.4;
  const Linkage linkage = on_incline(std::atan(0.5 * mu), dry(mu, 0.3));
  const Samples samples =
      run(compile(linkage), steps_of(1e-3, 100.0, 1.0), {"joint.J.q", "joint.J.friction"});
  ASSERT_EQ(samples.outcome.cause, Cause::ok) << samples.outcome.message;
  const double weight = 2.0 * linkage.gravity.z();
  const Eigen::Index last = samples.values.rows() - 1;
  EXPECT_NEAR(samples.values(last, 1), weight, 1e-9 * weight);
  // It sinks into its bristles, 0.5 mu / sigma0 and a little more, and then creeps no more.
  EXPECT_GT(samples.values(10, 0), 0.5 * mu / 200.0);
  EXPECT_LT(std::abs(samples.values(last, 0) - samples.values(10, 0)), 1e-9);
}

TEST(Joint_friction, A_wheel_is_braked_by_its_weight_at_the_radius_of_its_bearing) {
  JointFriction f = dry(0.1, 0.1);
  f.radius = 0.02;
  Linkage linkage = one_joint(JointType::revolute, block(5.0), f);
  linkage.gravity = {0.0, -kGravity, 0.0};
  linkage.joints[0].velocity = {50.0};
  const Samples samples =
      run(compile(linkage), steps_of(1e-5, 1.0, 0.5), {"joint.J.v", "joint.J.normal_load"});
  const double braking = 0.1 * 5.0 * kGravity * 0.02 / 0.1;  // mu W r / I
  EXPECT_NEAR(samples.values(1, 0) - samples.values(2, 0), 0.5 * braking, 1e-8);
  EXPECT_NEAR(samples.values(2, 1), 5.0 * kGravity, 1e-9);
}

// The load on the supports comes from the braking itself: with the centre of mass h above the rail
// and supports l apart, N = N0 + 2 m a h / l and a = mu N / m, so a = mu N0 / m / (1 - 2 mu h / l).
TEST(Joint_friction, Load_and_acceleration_that_depend_on_each_other_are_found_together) {
  const double mu = 0.3, h = 0.1, l = 0.2, preload = 20.0;
  JointFriction f = dry(mu, mu);
  f.length = l;
  f.preload = preload;
  f.law.sigma1 = 0.0;  // fresh bristles damped by sigma1 would jam it: mu(0) = sigma1 v
  Linkage linkage = one_joint(JointType::prismatic, block(2.0, {0.0, h, 0.0}), f);
  linkage.joints[0].velocity = {10.0};
  const Samples samples = run(compile(linkage), steps_of(1e-5, 0.5, 0.5),
                              {"joint.J.a", "joint.J.normal_load", "joint.J.friction"});
  ASSERT_EQ(samples.outcome.cause, Cause::ok) << samples.outcome.message;
  const double a = mu * preload / 2.0 / (1.0 - 2.0 * mu * h / l);
  EXPECT_NEAR(-samples.values(1, 0), a, 1e-6 * a);
  EXPECT_NEAR(samples.values(1, 1), preload + 2.0 * 2.0 * a * h / l, 1e-6 * preload);
  EXPECT_NEAR(samples.values(1, 2), 2.0 * a, 1e-6 * 2.0 * a);
}

// 2 mu h / l > 1: every load asks for more braking and every braking for more load.
TEST(Joint_friction, A_rail_that_jams_ends_the_run_with_a_cause) {
  JointFriction f = dry(0.6, 0.6);
  f.length = 0.1;
  f.preload = 20.0;
  Linkage linkage = one_joint(JointType::prismatic, block(2.0, {0.0, 0.2, 0.0}), f);
  linkage.joints[0].velocity = {10.0};
  const SimulationOutcome end = run(compile(linkage), steps_of(1e-5, 0.5));
  EXPECT_EQ(end.cause, Cause::diverged);
}

// Braking that lowers its own load: F along the rail and the centre of mass d off it, no preload:
// N = 2 d a / l with m a = F - mu N, so N = (2 d / l) F / (1 + 2 mu d / l). From 2 mu d / l = 1 on
// there is a second balance, in which friction overcomes the force.
TEST(Joint_friction, A_load_that_its_own_friction_lowers_is_found) {
  const double force = 10.0, d = 0.05, l = 0.02;
  for (const double mu : {0.1, 0.14, 0.17, 0.19}) {
    JointFriction f = dry(mu, mu);
    f.length = l;
    f.law.sigma1 = 0.0;
    Linkage linkage = one_joint(JointType::prismatic, block(1.0, {0.0, d, 0.0}), f);
    linkage.joints[0].velocity = {1.0};
    Load push;
    push.name = "push";
    push.joint = "J";
    push.course.shape = CourseShape::constant;
    push.course.value = force;
    linkage.loads = {push};
    SimulationOptions options = steps_of(1e-5, 0.05, 0.05);
    const Preparation prepared = prepare(linkage, options);
    ASSERT_EQ(prepared.cause, Cause::ok) << prepared.message;
    const Samples samples = run(prepared.model, options, {"joint.J.normal_load"});
    ASSERT_EQ(samples.outcome.cause, Cause::ok) << mu << ": " << samples.outcome.message;
    const double load = 2.0 * d / l * force / (1.0 + 2.0 * mu * d / l);
    // It slid before the run began: bristles are those of steady sliding from the first instant.
    EXPECT_NEAR(samples.values(0, 0), load, 1e-6 * load) << mu;
    EXPECT_NEAR(samples.values(1, 0), load, 1e-6 * load) << mu;
  }
}

// Several joints at once, each with a load that depends on the others: friction everywhere on the
// RSRRP, against loads found by plain substitution from outside where that converges.
TEST(Joint_friction, Loads_of_joints_that_depend_on_each_other_are_in_balance) {
  Linkage linkage = rsrrp();
  for (Joint& joint : linkage.joints) {
    joint.friction = dry(0.3, 0.3);
    joint.friction->radius = 0.02;
    joint.friction->length = 0.03;
  }
  linkage.joints[0].velocity = {3.0};
  const SimulationOptions options = steps_of(1e-5, 0.2, 0.01);
  const Preparation prepared = prepare(linkage, options);
  std::vector<std::string> signals;
  for (const char* joint : {"A", "P", "Q", "R"}) {
    for (const char* quantity :
         {".normal_load", ".friction", ".v", ".force_local", ".torque_local"}) {
      signals.push_back(std::string("joint.") + joint + quantity);
    }
  }
  const Samples samples = run(prepared.model, options, signals);
  ASSERT_EQ(samples.outcome.cause, Cause::ok) << samples.outcome.message;
  for (Eigen::Index row = 0; row < samples.values.rows(); ++row) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      const auto at = samples.values.row(row).segment(9 * j, 9);
      const Vector3d force(at[3], at[4], 0.0), torque(at[6], at[7], at[8]);
      const Vector3d couple = Vector3d::UnitZ().cross(torque) / 0.03;
      double load = (0.5 * force + couple).norm() + (0.5 * force - couple).norm();
      if (j == 1) load += std::abs(torque.z()) / 0.02;
      EXPECT_NEAR(at[0], load, 1e-8 * (1.0 + load)) << row << " " << j;
    }
  }
}

TEST(Joint_friction, The_spectrum_knows_the_stiffness_of_bristles) {
  JointFriction f = dry(0.2, 0.2);
  f.preload = 100.0;
  f.law.sigma1 = 0.0;
  const Linkage linkage = one_joint(JointType::prismatic, block(2.0), f);
  const Model model = compile(linkage);
  const double omega = std::sqrt(200.0 * 100.0 / 2.0);  // sigma0 N / m
  EXPECT_NEAR(compute_spectrum(model, model.start).omega_max, omega, 1e-3 * omega);
}

// A screwing slider: friction acts against the whole sliding velocity, (r omega, v).
TEST(Joint_friction, In_a_cylindrical_joint_friction_acts_along_the_helix) {
  JointFriction f = dry(0.2, 0.2);
  f.radius = 0.05;
  f.preload = 100.0;
  Linkage linkage = one_joint(JointType::cylindrical, block(2.0), f);
  linkage.joints[0].velocity = {60.0, 4.0};  // 3 m/s around, 4 m/s along
  const Samples samples =
      run(compile(linkage), steps_of(1e-5, 0.01, 0.01), {"joint.J.friction", "joint.J.v"});
  const double around = 0.05 * samples.values(1, 2), along = samples.values(1, 3);
  const double speed = std::hypot(around, along);  // turns slowly: bristles lag by 1 %
  EXPECT_LT(speed, 4.99);
  EXPECT_NEAR(samples.values(1, 0), 0.2 * 100.0 * (around / speed) * 0.05, 5e-3);
  EXPECT_NEAR(samples.values(1, 1), 0.2 * 100.0 * (along / speed), 0.1);
}

TEST(Joint_friction, The_energy_ledger_holds_through_stick_and_slip) {
  JointFriction f = dry(0.4, 0.2);
  f.radius = 0.1;
  f.length = 0.05;
  f.preload = 5.0;
  Linkage linkage = one_joint(JointType::revolute, block(1.0, {0.0, -0.3, 0.02}), f);
  linkage.gravity = {0.0, -kGravity, 0.0};
  linkage.joints[0].position = {1.2};
  const SimulationOutcome end = run(compile(linkage), steps_of(1e-5, 3.0, 1e-3));
  ASSERT_EQ(end.cause, Cause::ok) << end.message;
  EXPECT_LT(end.energy_residual_max, 1e-8 * end.energy_scale);
  EXPECT_GT(end.final_state.dissipated, 1.0) << "most of its swing is gone";
}

// Springs and dampers on coordinates.
TEST(Joint_spring, A_turning_mass_swings_about_the_rest_angle_and_loses_what_the_damper_takes) {
  Linkage linkage = one_joint(JointType::revolute, block(1.0), {});
  linkage.joints[0].friction.reset();
  linkage.joints[0].stiffness = {40.0};  // I = 0.1: 20 rad/s
  linkage.joints[0].damping = {0.4};     // zeta = 0.1
  linkage.joints[0].rest = {0.3};
  linkage.joints[0].position = {0.5};
  const double omega = 20.0, zeta = 0.1, t = 0.37;
  const Samples samples = run(compile(linkage), steps_of(1e-4, t, t),
                              {"joint.J.q", "energy.potential", "energy.residual"});
  const double damped = omega * std::sqrt(1.0 - zeta * zeta);
  const double q =
      0.3 + 0.2 * std::exp(-zeta * omega * t) *
                (std::cos(damped * t) + zeta / std::sqrt(1.0 - zeta * zeta) * std::sin(damped * t));
  EXPECT_NEAR(samples.values(1, 0), q, 1e-9);
  EXPECT_NEAR(samples.values(1, 1), 20.0 * (q - 0.3) * (q - 0.3), 1e-8);
  EXPECT_NEAR(samples.values(1, 2), 0.0, 1e-10);
}

}  // namespace linkstudy::testing::joint_friction_test
