// Modes against closed forms.
#include "core/dynamics/modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/kinematics/assembly.h"
#include "core/simulation/prepare.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/mass_on_spring.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/rsrrp.h"

namespace linkstudy::testing::modes_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;

std::vector<Mode> modes_of(const Linkage& linkage) {
  const Model model = compile(linkage);
  return compute_modes(model, model.start);
}

}  // namespace

TEST(Modes, Of_a_mass_on_a_damped_spring) {
  const double m = 2.0, c = 800.0, b = 12.0;
  const std::vector<Mode> modes = modes_of(mass_on_spring(m, c, b));
  const Mode& up = modes.front();
  EXPECT_NEAR(up.frequency, std::sqrt(c / m), 1e-9);
  EXPECT_NEAR(up.damping, b / (2.0 * std::sqrt(c * m)), 1e-12);
  EXPECT_NEAR(up.eigenvalue.imag(), std::sqrt(c / m - b * b / (4 * m * m)), 1e-9);
}

TEST(Modes, Of_an_overdamped_one_do_not_swing) {
  const double m = 2.0, c = 800.0, b = 200.0;
  const std::vector<Mode> modes = modes_of(mass_on_spring(m, c, b));
  ASSERT_EQ(modes.size(), 2u);
  const double root = std::sqrt(b * b - 4 * m * c);
  EXPECT_NEAR(modes[0].frequency, (b - root) / (2 * m), 1e-9);
  EXPECT_NEAR(modes[1].frequency, (b + root) / (2 * m), 1e-9);
  for (const Mode& mode : modes) EXPECT_NEAR(mode.damping, 1.0, 1e-12);
}

TEST(Modes, Of_a_pendulum_hanging_and_upright) {
  Linkage linkage = pendulum(1.0, 0.7);
  linkage.joints[0].position = {-std::numbers::pi / 2};
  const std::vector<Mode> hanging = modes_of(linkage);
  ASSERT_EQ(hanging.size(), 1u);
  EXPECT_NEAR(hanging[0].frequency, std::sqrt(kGravity / 0.7), 1e-10);
  EXPECT_NEAR(hanging[0].damping, 0.0, 1e-12);
  linkage.joints[0].position = {std::numbers::pi / 2};
  const std::vector<Mode> upright = modes_of(linkage);
  ASSERT_EQ(upright.size(), 2u);
  EXPECT_NEAR(std::min(upright[0].damping, upright[1].damping), -1.0, 1e-12);
}

// Two equal point pendulums, one on the other: w^2 = (2 -+ sqrt 2) g / l, and the angle of the
// second against the vertical is +-sqrt 2 times that of the first.
TEST(Modes, Of_a_double_pendulum) {
  Linkage linkage = pendulum(1.0, 0.5);
  linkage.joints[0].position = {-std::numbers::pi / 2};
  linkage.links.push_back({"lower", 1.0, Vector3d(0.5, 0, 0), Matrix3d::Zero(), {}});
  linkage.joints.push_back(joint_at("B", JointType::revolute, "rod", "lower", along_x(0.5)));
  const std::vector<Mode> modes = modes_of(linkage);
  ASSERT_EQ(modes.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1.0 : -1.0;
    EXPECT_NEAR(modes[static_cast<std::size_t>(i)].frequency,
                std::sqrt((2.0 - sign * std::numbers::sqrt2) * kGravity / 0.5), 1e-9);
    const Eigen::VectorXcd& shape = modes[static_cast<std::size_t>(i)].shape;
    EXPECT_NEAR(((shape[0] + shape[1]) / shape[0]).real(), sign * std::numbers::sqrt2, 1e-9);
    EXPECT_NEAR(shape.cwiseAbs().maxCoeff(), 1.0, 1e-12);
  }
}

// A cut joint leaves the modes of the freedoms that are left; a stiff sde has the same and faster
// ones beyond.
TEST(Modes, Of_a_closed_linkage_are_those_of_a_stiff_replacement_joint) {
  Linkage linkage = rsrrp();
  linkage.loads.clear();
  const RsrrpPose pose = rsrrp_pose(2.0);
  const double positions[] = {pose.psi, pose.d, pose.psi22, pose.psi23};
  for (std::size_t i = 0; i < 4; ++i) linkage.joints[i].position = {positions[i]};
  linkage.joints[1].stiffness = {2000.0};  // of the slider
  linkage.joints[1].rest = {pose.d};
  SimulationOptions options;
  options.start = Start::equilibrium;
  const Preparation cut = prepare(linkage, options);
  ASSERT_EQ(cut.cause, Cause::ok) << cut.message;
  const std::vector<Mode> exact = compute_modes(cut.model, cut.model.start);
  ASSERT_EQ(exact.size(), 1u);
  linkage.closures[0].model = ClosureModel::sde;
  linkage.closures[0].sde.stiffness = {1e9, 1e9, 1e9, 0, 0, 0};
  linkage.closures[0].sde.damping = {};
  const Preparation stiff = prepare(linkage, options);
  ASSERT_EQ(stiff.cause, Cause::ok) << stiff.message;
  const std::vector<Mode> replaced = compute_modes(stiff.model, stiff.model.start);
  ASSERT_EQ(replaced.size(), 4u);
  EXPECT_NEAR(replaced[0].frequency, exact[0].frequency, 1e-5 * exact[0].frequency);
  EXPECT_GT(replaced[1].frequency, 100.0 * exact[0].frequency);
}

TEST(Modes, Without_anything_that_holds_have_no_frequency) {
  Linkage linkage = pendulum();
  linkage.gravity.setZero();
  const std::vector<Mode> modes = modes_of(linkage);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_EQ(modes[0].frequency, 0.0);
  Motion motion;
  motion.name = "m";
  motion.joint = "A";
  linkage.motions = {motion};
  EXPECT_TRUE(modes_of(linkage).empty());
}

}  // namespace linkstudy::testing::modes_test
