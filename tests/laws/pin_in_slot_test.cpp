// The closure of a pin in a slot, cut and as springs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/kinematics/mobility.h"
#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::pin_in_slot_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSpeed = 3.0, kStart = 0.2, kMass = 0.7;  // rad/s, m, kg

// A rod that turns about z at constant speed, and a bead on it, free but for the slot.
Linkage bead_on_rod(ClosureModel model) {
  Linkage linkage;
  linkage.name = "bead";
  linkage.links = {{"rod", 1.0, Vector3d::Zero(), Matrix3d::Identity(), {}},
                   {"bead", kMass, Vector3d::Zero(), 1e-3 * Matrix3d::Identity(), {}}};
  Joint bead = joint_at("B", JointType::free, kGround, "bead", {});
  bead.position = {kStart, 0, 0, 0, 0, 0};
  bead.velocity = {0, kSpeed * kStart, 0, 0, 0, 0};
  linkage.joints = {joint_at("A", JointType::revolute, kGround, "rod", {}), bead};
  Closure slot;
  slot.name = "slot";
  slot.type = JointType::pin_in_slot;
  slot.first.link = "rod";
  slot.second.link = "bead";
  slot.model = model;
  slot.stabilization = model == ClosureModel::cut ? Stabilization::projection : Stabilization::none;
  slot.sde.axes = SdeAxes::first;
  slot.sde.stiffness = {0, 1e8, 1e8, 0, 0, 0};
  slot.sde.damping = {0, 2e3, 2e3, 0, 0, 0};
  linkage.closures = {slot};
  Motion motion;
  motion.name = "m";
  motion.joint = "A";
  motion.speed = kSpeed;
  linkage.motions = {motion};
  return linkage;
}

Samples run_of(ClosureModel model, double step) {
  return run(compile(bead_on_rod(model)), steps_of(step, 1.0, 0.1),
             {"time", "joint.A.q", "joint.B.q.0", "joint.B.q.1", "closure.slot.force.x",
              "closure.slot.force.y"});
}

// r'' = w^2 r: r = r0 cosh(w t), and the rod pushes with 2 m w r'.
void expect_bead(const Samples& s, double place, double force) {
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    const double t = s.values(i, 0), angle = kSpeed * t;
    const double r = kStart * std::cosh(kSpeed * t);
    const double push = 2 * kMass * kSpeed * kSpeed * kStart * std::sinh(kSpeed * t);
    EXPECT_NEAR(s.values(i, 2), r * std::cos(angle), place);
    EXPECT_NEAR(s.values(i, 3), r * std::sin(angle), place);
    // On the rod: against the push on the bead.
    EXPECT_NEAR(s.values(i, 4), push * std::sin(angle), force);
    EXPECT_NEAR(s.values(i, 5), -push * std::cos(angle), force);
  }
}

}  // namespace

TEST(PinInSlot, Lets_a_bead_fly_along_a_turning_rod) {
  expect_bead(run_of(ClosureModel::cut, 1e-3), 1e-9, 1e-8);
}

// Elements that turn with the slot, a hundred times stiffer than what moves.
TEST(PinInSlot, As_springs_does_so_but_for_their_deflection) {
  expect_bead(run_of(ClosureModel::sde, 2e-5), 1e-6, 1e-2);
}

TEST(PinInSlot, Blocks_two_of_six_directions) {
  Linkage linkage = bead_on_rod(ClosureModel::cut);
  const Model closed = compile_closed(linkage);
  State<double> start = closed.start;
  const AssemblyReport report = assemble_start(closed, start);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.rows, 2);
  EXPECT_EQ(analyse_mobility(closed, start).mobility, 5);
  EXPECT_EQ(velocity_count(JointType::pin_in_slot), 4);
}

// A pin off the slot is brought back to it, at any place along it.
TEST(PinInSlot, Is_assembled_where_it_is_nearest) {
  Linkage linkage = bead_on_rod(ClosureModel::cut);
  linkage.motions.clear();
  linkage.joints[0].hold = true;
  linkage.joints[1].position = {0.3, 0.05, -0.04, 0, 0, 0};
  const Model closed = compile_closed(linkage);
  State<double> start = closed.start;
  ASSERT_TRUE(assemble_start(closed, start).closed);
  EXPECT_NEAR(start.q[PositionIndex(1)], 0.3, 1e-9);
  EXPECT_NEAR(start.q[PositionIndex(2)], 0.0, 1e-9);
  EXPECT_NEAR(start.q[PositionIndex(3)], 0.0, 1e-9);
}

}  // namespace linkstudy::testing::pin_in_slot_test
