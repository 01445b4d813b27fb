// Linear relations between joint coordinates against closed forms: gears, racks, differentials; and
// the same linkage by two routes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/kinematics/mobility.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/placed_linkage.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::coupling_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;

Link wheel(const std::string& name, double inertia) {
  return {name, 1.0, Vector3d::Zero(), inertia * Matrix3d::Identity(), {}};
}

// Shafts a, b, .. beside each other, each about z of the ground.
Linkage shafts(const std::vector<double>& inertias) {
  Linkage linkage;
  const char* names[] = {"a", "b", "c", "d"};
  for (std::size_t i = 0; i < inertias.size(); ++i) {
    linkage.links.push_back(wheel(names[i], inertias[i]));
    linkage.joints.push_back(joint_at(std::string(1, static_cast<char>('A' + i)),
                                      JointType::revolute, kGround, names[i],
                                      along_x(0.1 * static_cast<double>(i))));
  }
  return linkage;
}

Load torque_on(const std::string& joint, double value) {
  Load load;
  load.name = "on_" + joint;
  load.type = LoadType::drive;
  load.joint = joint;
  load.course.shape = CourseShape::constant;
  load.course.value = value;
  return load;
}

Coupling coupling_of(std::vector<CouplingTerm> terms) {
  return {"g", std::move(terms), {}};
}

}  // namespace

// A pair of gears with radii r1, r2: r1 q1 + r2 q2 = 0. A torque T on the first turns it by
// T / (I1 + (r1 / r2)^2 I2).
TEST(Coupling, Of_a_pair_of_gears_adds_the_reduced_inertia) {
  constexpr double kI1 = 0.3, kI2 = 0.8, kRatio = 2.5, kTorque = 1.7;
  Linkage linkage = shafts({kI1, kI2});
  linkage.couplings = {coupling_of({{"A", 0, kRatio}, {"B", 0, 1.0}})};
  linkage.loads = {torque_on("A", kTorque)};
  EngineProbe probe(linkage);
  const double a = kTorque / (kI1 + kRatio * kRatio * kI2);
  EXPECT_NEAR(probe.at("joint.A.a"), a, 1e-14);
  EXPECT_NEAR(probe.at("joint.B.a"), -kRatio * a, 1e-14);
  // What turns the second shaft is effort times its factor.
  EXPECT_NEAR(probe.at("coupling.g.effort"), -kRatio * a * kI2, 1e-14);
  const Samples s = run(compile(linkage), steps_of(1e-3, 1.0, 0.1),
                        {"time", "joint.A.q", "joint.B.q", "energy.residual"});
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    const double t = s.values(i, 0);
    EXPECT_NEAR(s.values(i, 1), 0.5 * a * t * t, 1e-13);
    EXPECT_NEAR(kRatio * s.values(i, 1) + s.values(i, 2), 0.0, 1e-13);
    EXPECT_NEAR(s.values(i, 3), 0.0, 1e-13);
  }
}

// A rack of mass m on a pinion of radius r falls by m g / (m + I / r^2).
TEST(Coupling, Of_a_rack_and_its_pinion_lets_it_fall_slowly) {
  constexpr double kInertia = 0.02, kMass = 3.0, kRadius = 0.05;
  Linkage linkage = shafts({kInertia});
  linkage.gravity = {0.0, 0.0, -kGravity};
  linkage.links.push_back({"rack", kMass, Vector3d::Zero(), 1e-3 * Matrix3d::Identity(), {}});
  linkage.joints.push_back(joint_at("R", JointType::prismatic, kGround, "rack", {}));
  linkage.couplings = {coupling_of({{"R", 0, 1.0}, {"A", 0, -kRadius}})};
  EngineProbe probe(linkage);
  const double a = -kMass * kGravity / (kMass + kInertia / (kRadius * kRadius));
  EXPECT_NEAR(probe.at("joint.R.a"), a, 1e-13);
  EXPECT_NEAR(probe.at("joint.A.a"), a / kRadius, 1e-11);
  EXPECT_NEAR(probe.at("coupling.g.effort"), kMass * (kGravity + a), 1e-12);  // N, on the rack
}

// A differential: q_a + q_b = 2 q_c. With torque T on c and the inertias I_a, I_b, I_c, the
// multiplier l gives I_a a = l, I_b b = l, I_c c = T - 2 l, a + b = 2 c.
TEST(Coupling, Of_a_differential_shares_the_torque) {
  constexpr double kA = 0.5, kB = 0.2, kC = 0.1, kTorque = 3.0;
  Linkage linkage = shafts({kA, kB, kC});
  linkage.couplings = {coupling_of({{"A", 0, 1.0}, {"B", 0, 1.0}, {"C", 0, -2.0}})};
  linkage.loads = {torque_on("C", kTorque)};
  EngineProbe probe(linkage);
  const double l = 2.0 * kTorque / kC / (1.0 / kA + 1.0 / kB + 4.0 / kC);
  EXPECT_NEAR(probe.at("joint.A.a"), l / kA, 1e-12);
  EXPECT_NEAR(probe.at("joint.B.a"), l / kB, 1e-12);
  EXPECT_NEAR(probe.at("joint.C.a"), (kTorque - 2.0 * l) / kC, 1e-12);
  EXPECT_NEAR(probe.at("coupling.g.effort"), l, 1e-12);
  EXPECT_NEAR(probe.at("joint.A.torque_local.z"), l, 1e-12);
}

// Two coordinates of a random linkage coupled by q1 - q2 = 0, and the same with a second law that
// gives each its acceleration: efforts are those of the coupling.
TEST(Coupling, Puts_on_the_coordinates_what_keeps_them_together) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const ClosureModel model : {ClosureModel::cut, ClosureModel::sde}) {
      Linkage linkage = random_closed_linkage(seed, JointType::spherical, model);
      std::vector<std::string> turning;
      for (const Joint& joint : linkage.joints) {
        if (joint.type == JointType::revolute) turning.push_back(joint.name);
      }
      if (turning.size() < 2) continue;
      SCOPED_TRACE(std::to_string(seed));
      Linkage coupled = linkage;
      coupled.couplings = {coupling_of({{turning[0], 0, 1.0}, {turning[1], 0, -0.7}})};
      EngineProbe together(coupled);
      const double effort = together.at("coupling.g.effort");
      EXPECT_NEAR(together.at("joint." + turning[0] + ".a"),
                  0.7 * together.at("joint." + turning[1] + ".a"), 1e-9);
      Linkage loaded = linkage;
      loaded.loads.push_back(torque_on(turning[0], effort));
      loaded.loads.push_back(torque_on(turning[1], -0.7 * effort));
      EngineProbe apart(loaded);
      EXPECT_TRUE(near_relative(together.qdd(), apart.qdd(), 1e-9));
      const double scale = 1.0 + together.vector("closure.loop.force").norm();
      EXPECT_TRUE(near_absolute(together.vector("closure.loop.force"),
                                apart.vector("closure.loop.force"), 1e-9 * scale));
    }
  }
}

// A prescribed motion of one gear drives the other, and takes the torque of both.
TEST(Coupling, Passes_a_prescribed_motion_on) {
  constexpr double kI1 = 0.3, kI2 = 0.8, kRatio = 2.5;
  Linkage linkage = shafts({kI1, kI2});
  linkage.couplings = {coupling_of({{"A", 0, kRatio}, {"B", 0, 1.0}})};
  Motion motion;
  motion.name = "m";
  motion.joint = "A";
  motion.law = MotionLaw::sine;
  motion.amplitude = 0.4;
  motion.frequency = 0.5;
  motion.phase = 1.0;
  motion.from = 0.0;
  linkage.motions = {motion};
  // The gears start as the motion has them.
  linkage.couplings[0].offset = 0.0;
  const Preparation p = prepare(linkage, steps_of(1e-3, 2.0));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  const Samples s = run(p.model, steps_of(1e-3, 2.0, 0.1),
                        {"time", "joint.A.a", "joint.B.q", "motion.m.effort", "energy.residual"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    const double q = 0.4 * std::sin(std::numbers::pi * s.values(i, 0) + 1.0);
    const double a = -std::numbers::pi * std::numbers::pi * q;
    EXPECT_NEAR(s.values(i, 1), a, 1e-13);
    EXPECT_NEAR(s.values(i, 2), -kRatio * q, 1e-9);  // by integration
    EXPECT_NEAR(s.values(i, 3), (kI1 + kRatio * kRatio * kI2) * a, 1e-12);
    EXPECT_NEAR(s.values(i, 4), 0.0, 1e-9);
  }
}

// A five-bar has two freedoms; gears between its cranks leave one.
TEST(Coupling, Takes_a_freedom_of_a_five_bar) {
  Linkage linkage = five_bar();
  const Model free = compile_closed(linkage);
  State<double> start = free.start;
  ASSERT_TRUE(assemble_start(free, start).closed);
  const MobilityReport before = analyse_mobility(free, start);
  EXPECT_EQ(before.mobility, 2);
  std::vector<std::string> cranks;
  for (const Joint& joint : linkage.joints) {
    if (joint.parent == kGround) cranks.push_back(joint.name);
  }
  const std::string second = cranks.size() > 1 ? cranks[1] : linkage.joints.back().name;
  linkage.couplings = {coupling_of({{cranks[0], 0, 1.0}, {second, 0, 1.0}})};
  const Model geared = compile_closed(linkage);
  start = geared.start;
  ASSERT_TRUE(assemble_start(geared, start).closed);
  EXPECT_EQ(analyse_mobility(geared, start).mobility, 1);
}

// Twice the same: the rows depend, one of them bears nothing more than the other.
TEST(Coupling, Held_twice_is_redundant_and_named) {
  Linkage linkage = shafts({0.3, 0.8});
  linkage.couplings = {coupling_of({{"A", 0, 2.0}, {"B", 0, 1.0}}),
                       coupling_of({{"A", 0, 4.0}, {"B", 0, 2.0}})};
  linkage.couplings[1].name = "h";
  linkage.loads = {torque_on("A", 1.0)};
  const Preparation p = prepare(linkage, {});
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  ASSERT_EQ(p.warnings.size(), 1u);
  EXPECT_NE(p.warnings[0].find("coupling.g"), std::string::npos) << p.warnings[0];
  EngineProbe probe(linkage);
  EXPECT_NEAR(probe.at("joint.A.a"), 1.0 / (0.3 + 4.0 * 0.8), 1e-12);
}

TEST(Coupling, That_contradicts_the_start_moves_it) {
  Linkage linkage = shafts({0.3, 0.8});
  linkage.joints[0].position = {0.4};
  linkage.joints[0].hold = true;
  linkage.couplings = {coupling_of({{"A", 0, 2.0}, {"B", 0, 1.0}})};
  linkage.couplings[0].offset = 0.0;
  const Preparation p = prepare(linkage, {});
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_NEAR(p.model.start.q[PositionIndex(1)], -0.8, 1e-12);
  linkage.joints[1].hold = true;
  const Preparation stuck = prepare(linkage, {});
  EXPECT_EQ(stuck.cause, Cause::assembly_failed);
  EXPECT_NE(stuck.message.find("coupling.g is off by 0.8"), std::string::npos) << stuck.message;
}

}  // namespace linkstudy::testing::coupling_test
