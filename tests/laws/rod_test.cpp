// The closure of a rod without mass, cut and as a spring.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/flexible/rigid_finite_elements.h"
#include "core/kinematics/mobility.h"
#include "core/simulation/prepare.h"
#include "core/topology/check_linkage.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::rod_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Frame at_place(const Vector3d& place) {
  return {Matrix3d::Identity(), place};
}

Closure rod_between(const std::string& first, const Vector3d& place_1, const std::string& second,
                    const Vector3d& place_2, double length, ClosureModel model) {
  Closure rod;
  rod.name = "rod";
  rod.type = JointType::rod;
  rod.length = length;
  rod.first = {first, {Matrix3d::Identity(), place_1}};
  rod.second = {second, {Matrix3d::Identity(), place_2}};
  rod.model = model;
  rod.stabilization = model == ClosureModel::cut ? Stabilization::projection : Stabilization::none;
  rod.sde.axes = SdeAxes::first;
  rod.sde.stiffness = {1e8, 0, 0, 0, 0, 0};
  rod.sde.damping = {2e3, 0, 0, 0, 0, 0};
  return rod;
}

constexpr double kMass = 0.7, kLength = 0.5, kTilt = 0.4, kGravity = 9.81;

// A free body that hangs at its centre of mass on a rod, and circles below the other end at the
// speed at which its tilt stays.
Linkage conical_pendulum(ClosureModel model) {
  Linkage linkage;
  linkage.name = "conical pendulum";
  linkage.links = {{"bob", kMass, Vector3d::Zero(), 1e-3 * Matrix3d::Identity(), {}}};
  linkage.gravity = {0, 0, -kGravity};
  Joint joint = joint_at("B", JointType::free, kGround, "bob", {});
  const double radius = kLength * std::sin(kTilt);
  const double speed = std::sqrt(kGravity * radius * std::tan(kTilt));
  joint.position = {radius, 0, -kLength * std::cos(kTilt), 0, 0, 0};
  joint.velocity = {0, speed, 0, 0, 0, 0};
  linkage.joints = {joint};
  linkage.closures = {
      rod_between(kGround, Vector3d::Zero(), "bob", Vector3d::Zero(), kLength, model)};
  return linkage;
}

Samples run_of(ClosureModel model, double step) {
  return run(
      compile(conical_pendulum(model)), steps_of(step, 1.0, 0.1),
      {"time", "joint.B.q.0", "joint.B.q.1", "joint.B.q.2", "closure.rod.force.x",
       "closure.rod.force.y", "closure.rod.force.z", "closure.rod.gap.x", "closure.rod.gap.z"});
}

// x = r cos wt, y = r sin wt, z = -h; the rod pulls with m g / cos(tilt) along itself.
// `first`: the row from which forces are looked at.
void expect_circle(const Samples& s, double place, double force, double gap, Eigen::Index first) {
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  const double r = kLength * std::sin(kTilt), h = kLength * std::cos(kTilt);
  const double rate = std::sqrt(kGravity / h);
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    const double angle = rate * s.values(i, 0);
    EXPECT_NEAR(s.values(i, 1), r * std::cos(angle), place);
    EXPECT_NEAR(s.values(i, 2), r * std::sin(angle), place);
    EXPECT_NEAR(s.values(i, 3), -h, place);
    if (i < first) continue;
    // On ground, at the first end: towards the bob.
    const double across = kMass * kGravity * std::tan(kTilt);
    EXPECT_NEAR(s.values(i, 4), across * std::cos(angle), force);
    EXPECT_NEAR(s.values(i, 5), across * std::sin(angle), force);
    EXPECT_NEAR(s.values(i, 6), -kMass * kGravity, force);
    EXPECT_NEAR(s.values(i, 7), 0.0, gap);
    EXPECT_NEAR(s.values(i, 8), 0.0, gap);
  }
}

constexpr double kCrank = 0.1, kRocker = 0.3, kBase = 0.4, kCoupler = 0.35;  // m
constexpr double kRockerInertia = 0.02;                                      // about its pivot

// Angle of the rocker from that of the crank ([McCarthy] loop equation of the four-bar).
double rocker_angle(double crank) {
  const double x = kCrank * std::cos(crank) - kBase, y = kCrank * std::sin(crank);
  const double far = std::hypot(x, y);
  const double beside =
      std::acos((far * far + kRocker * kRocker - kCoupler * kCoupler) / (2 * far * kRocker));
  return std::atan2(y, x) - beside;
}

// A crank-rocker in the plane whose coupler is a rod; the crank turns evenly.
Linkage crank_rocker(ClosureModel model) {
  Linkage linkage;
  linkage.name = "crank-rocker";
  linkage.links = {{"crank", 1.0, Vector3d::Zero(), 0.01 * Matrix3d::Identity(), {}},
                   {"rocker", 1.0, Vector3d::Zero(), kRockerInertia * Matrix3d::Identity(), {}}};
  linkage.gravity = Vector3d::Zero();
  linkage.joints = {joint_at("A", JointType::revolute, kGround, "crank", {}),
                    joint_at("D", JointType::revolute, kGround, "rocker", at_place({kBase, 0, 0}))};
  linkage.joints[1].position = {rocker_angle(0.0)};
  linkage.closures = {
      rod_between("crank", {kCrank, 0, 0}, "rocker", {kRocker, 0, 0}, kCoupler, model)};
  Motion motion;
  motion.name = "turning";
  motion.joint = "A";
  motion.law = MotionLaw::speed;
  motion.speed = 4.0;
  linkage.motions = {motion};
  return linkage;
}

double wrapped(double angle) {
  return std::remainder(angle, 2 * kPi);
}

}  // namespace

TEST(Rod, Carries_a_conical_pendulum) {
  expect_circle(run_of(ClosureModel::cut, 1e-3), 1e-9, 1e-8, 1e-9, 0);
}

// As a spring it is longer by m g / (c cos tilt) = 7.5e-8 m: at the start not yet.
TEST(Rod, As_a_spring_does_so_but_for_its_stretch) {
  expect_circle(run_of(ClosureModel::sde, 2e-5), 1e-6, 1e-1, 2e-7, 1);
}

TEST(Rod, Is_the_coupler_of_a_crank_rocker) {
  const Samples s = run(compile(crank_rocker(ClosureModel::cut)), steps_of(1e-4, 1.6, 0.05),
                        {"joint.A.q", "joint.D.q", "joint.D.a", "closure.rod.force.x",
                         "closure.rod.force.y", "motion.turning.effort"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    const double crank = s.values(i, 0), rocker = s.values(i, 1);
    EXPECT_NEAR(wrapped(rocker - rocker_angle(crank)), 0.0, 1e-9);
    // On the crank; the opposite turns the rocker.
    const double fx = s.values(i, 3), fy = s.values(i, 4);
    const double moment = -kRocker * (std::cos(rocker) * fy - std::sin(rocker) * fx);
    EXPECT_NEAR(kRockerInertia * s.values(i, 2), moment, 1e-9);
    const double on_crank = kCrank * (std::cos(crank) * fy - std::sin(crank) * fx);
    EXPECT_NEAR(s.values(i, 5), -on_crank, 1e-9);
  }
}

// Two routes: the same linkage with an element as stiff as that between two points.
TEST(Rod, As_a_spring_is_a_spring_between_points) {
  const Linkage replaced = crank_rocker(ClosureModel::sde);
  Linkage sprung = replaced;
  sprung.closures.clear();
  PointSpring spring;
  spring.name = "s";
  spring.first = {"crank", {kCrank, 0, 0}};
  spring.second = {"rocker", {kRocker, 0, 0}};
  spring.stiffness = replaced.closures[0].sde.stiffness[kX];
  spring.damping = replaced.closures[0].sde.damping[kX];
  spring.free_length = kCoupler;
  sprung.springs = {spring};
  Linkage apart = replaced;  // both begin at a pose that is not closed
  for (Linkage* linkage : {&apart, &sprung}) linkage->joints[1].position = {-2.4};
  for (const double time : {0.0, 0.3}) {
    const EngineProbe a(apart, time), b(sprung, time);
    EXPECT_NEAR(a.qdd()[1], b.qdd()[1], 1e-9 * std::abs(b.qdd()[1]));
  }
}

TEST(Rod, Blocks_one_of_six_directions) {
  const Linkage linkage = conical_pendulum(ClosureModel::cut);
  const Model closed = compile_closed(linkage);
  State<double> start = closed.start;
  const AssemblyReport report = assemble_start(closed, start);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.rows, 1);
  EXPECT_EQ(analyse_mobility(closed, start).mobility, 5);
  EXPECT_EQ(velocity_count(JointType::rod), 5);
}

// Along the line between its ends it is brought to its length.
TEST(Rod, Is_assembled_along_its_line) {
  Linkage linkage = conical_pendulum(ClosureModel::cut);
  linkage.joints[0].position = {0.3, 0, -0.3, 0, 0, 0};
  const Model closed = compile_closed(linkage);
  State<double> start = closed.start;
  ASSERT_TRUE(assemble_start(closed, start).closed);
  EXPECT_NEAR(
      std::hypot(start.q[PositionIndex(0)], start.q[PositionIndex(1)], start.q[PositionIndex(2)]),
      kLength, 1e-12);
  EXPECT_NEAR(start.q[PositionIndex(0)], -start.q[PositionIndex(2)], 1e-9);
}

// Four upright rods carry a table of which three would hold the height and tilts: each a quarter.
TEST(Rod, Of_a_table_on_four_shares_its_weight) {
  Linkage linkage;
  linkage.name = "table";
  linkage.gravity = {0, 0, -kGravity};
  linkage.links = {{"table", 2.0, Vector3d::Zero(), Matrix3d::Identity(), {}}};
  linkage.joints = {joint_at("T", JointType::free, kGround, "table", at_place({0, 0, -1}))};
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    linkage.closures.push_back(rod_between(kGround, {1.0 * x, 1.0 * y, 0}, "table",
                                           {1.0 * x, 1.0 * y, 0}, 1.0, ClosureModel::cut));
    linkage.closures.back().name = "rod" + std::to_string(linkage.closures.size());
  }
  EngineProbe engine(linkage, 0.0);
  for (int i = 1; i <= 4; ++i) {
    const Vector3d force = engine.vector("closure.rod" + std::to_string(i) + ".force");
    EXPECT_NEAR(force.z(), -2.0 * kGravity / 4, 1e-9);
    EXPECT_NEAR(force.x(), 0.0, 1e-12);
  }
}

// On a bending rocker; its ledger closes, cut and as a spring, and it moves nearly as a rigid one.
TEST(Rod, Holds_a_flexible_link) {
  Linkage rigid = crank_rocker(ClosureModel::cut);
  rigid.links[1].center_of_mass = {kRocker / 2, 0, 0};
  rigid.links[1].inertia = Vector3d(1e-4, 7.6e-3, 7.6e-3).asDiagonal();  // > m l^2 / 12
  const std::vector<std::string> names = {"joint.D.q", "energy.residual", "energy.kinetic"};
  const Samples stiff = run(compile(rigid), steps_of(1e-5, 0.5, 0.05), names);
  for (const ClosureModel model : {ClosureModel::cut, ClosureModel::sde}) {
    Linkage bending = rigid;
    Closure& rod = bending.closures[0];
    rod.model = model;
    rod.stabilization =
        model == ClosureModel::cut ? Stabilization::projection : Stabilization::none;
    const double section = 5e-9;  // m^4: a bar of 16 mm
    bending.links[1].flexible = FlexibleBeam{.segments = 2,
                                             .begin = Vector3d::Zero(),
                                             .end = {kRocker, 0, 0},
                                             .across = Vector3d::UnitY(),
                                             .young = 2e11,
                                             .shear = 8e10,
                                             .second_moment_y = section,
                                             .second_moment_z = section,
                                             .torsion_constant = 2 * section,
                                             .retardation = 1e-5,
                                             .position = {},
                                             .velocity = {}};
    const SimulationOptions options = steps_of(2e-6, 0.5, 0.05);
    const Preparation start = prepare(expand_flexible_links(bending), options);
    ASSERT_EQ(start.cause, Cause::ok) << start.message;
    const Samples s = run(start.model, options, names);
    ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
    EXPECT_LT((s.values.col(0) - stiff.values.col(0)).cwiseAbs().maxCoeff(), 2e-3);
    EXPECT_LT(s.values.col(1).cwiseAbs().maxCoeff(), 1e-8 * s.values.col(2).maxCoeff());
  }
}

TEST(Rod, Needs_a_length_and_nothing_across_it) {
  Linkage linkage = conical_pendulum(ClosureModel::sde);
  linkage.closures[0].length = 0.0;
  linkage.closures[0].sde.stiffness[kY] = 1.0;
  linkage.closures[0].sde.damping[kPsi] = 2.0;
  std::vector<std::string> paths;
  for (const Problem& problem : check(linkage)) paths.push_back(problem.path);
  const std::vector<std::string> expected = {"closure.rod.length", "closure.rod.sde.stiffness.y",
                                             "closure.rod.sde.damping.psi"};
  EXPECT_EQ(paths, expected);
}

}  // namespace linkstudy::testing::rod_test
