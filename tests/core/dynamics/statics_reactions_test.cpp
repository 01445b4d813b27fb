// What statics reports beside the pose: reactions by two routes, efforts of holds, stiffness with
// its unit, platforms with idle legs, and snap-through with its limit load.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/dynamics/statics.h"
#include "core/kinematics/idle_rows.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/mass_on_spring.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/placed_linkage.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/von_mises_truss.h"
#include "tests/support/engine_probe.h"
#include "tests/support/free_bodies.h"
#include "tests/support/near.h"

namespace linkstudy::testing::statics_reactions_test {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

constexpr double kGravity = 9.81;

struct Rest {
  Model model;
  State<double> state;
  StaticsReport report;
};

Rest rest_of(const Linkage& linkage) {
  Rest r{compile(linkage, find_idle_directions(linkage)), {}, {}};
  r.state = r.model.start;
  r.report = solve_statics(r.model, r.state);
  return r;
}

// Channels of the first instant of a run from rest, holds as loads.
Vector values_of(const Rest& rest, const std::vector<std::string>& signals) {
  Model held = with_holding_efforts(rest.model, rest.report);
  held.start.q = rest.state.q;
  std::fill(held.start.v.begin(), held.start.v.end(), 0.0);
  return run(held, steps_of(1e-6, 1e-6, 1e-6), signals).values.row(0);
}

Linkage block_on_incline(double slope) {
  Linkage linkage = mass_on_spring(2.0, 0.0);
  linkage.closures.clear();
  linkage.gravity = {kGravity * std::cos(slope), 0, -kGravity * std::sin(slope)};
  return linkage;
}

// Newton and Euler, link by link, at rest: weights, closure wrenches, and nothing else.
void expect_free_bodies_at_rest(const Linkage& linkage) {
  SCOPED_TRACE(linkage.name);
  const Rest rest = rest_of(linkage);
  ASSERT_TRUE(rest.report.converged) << rest.report.reason;
  const Mechanism& m = rest.model.mechanism;
  ASSERT_EQ(m.nq, m.nv);
  const Vector q = Eigen::Map<const Vector>(rest.state.q.data(), m.nq);
  const Vector none = Vector::Zero(m.nv);
  const auto motions = link_motions(linkage, q, none, none);
  std::vector<ExternalWrench> wrenches = load_wrenches(linkage, motions, 0.0);
  for (const Closure& c : linkage.closures) {
    const Vector w =
        values_of(rest, {"closure." + c.name + ".force", "closure." + c.name + ".torque"});
    const auto place = [&](const ClosureEnd& end) {
      return end.link == kGround ? end.frame.position
                                 : point_motion(motion_of(motions, end.link), end.frame.position).p;
    };
    const Vector3d f = w.head<3>(), n = w.tail<3>();
    if (c.first.link != kGround) wrenches.push_back({c.first.link, place(c.first), f, n});
    if (c.second.link != kGround) wrenches.push_back({c.second.link, place(c.second), -f, -n});
  }
  for (const JointReaction& r : joint_reactions(linkage, motions, wrenches).joints) {
    const std::string name = "joint." + r.joint;
    const Vector w = values_of(rest, {name + ".force", name + ".torque"});
    // Statics leaves 1e-9 of the weights over.
    EXPECT_TRUE(near_absolute(w.head<3>(), r.force, 1e-6)) << name;
    EXPECT_TRUE(near_absolute(w.tail<3>(), r.torque, 1e-6)) << name;
  }
}

Linkage hanging_rsrrp(ClosureModel model) {
  Linkage linkage = rsrrp();
  const RsrrpPose start = rsrrp_pose(2.9);
  for (std::size_t k = 0; k < 4; ++k) {
    linkage.joints[k].position = {std::array{start.psi, start.d, start.psi22, start.psi23}[k]};
  }
  linkage.closures[0].model = model;
  linkage.closures[0].sde.stiffness = {1e6, 1e6, 1e6, 0, 0, 0};
  return linkage;
}

// Platform and upper parts of the legs 1 kg each; springs of 2e4 N/m carry them.
Linkage resting_platform(bool idle_spins) {
  Linkage linkage = stewart_platform();
  linkage.gravity = {0, 0, -kGravity};
  for (Link& link : linkage.links) {
    if (link.name == "platform") link.center_of_mass = {0, 0, 1.1};
  }
  for (Joint& joint : linkage.joints) {
    if (joint.type == JointType::prismatic) joint.stiffness = {2e4};
    if (joint.type == JointType::universal && idle_spins) {
      joint.type = JointType::spherical;
      joint.position.clear();
      joint.velocity.clear();
    }
  }
  return linkage;
}

}  // namespace

TEST(StaticReactions, Recursive_Newton_Euler_and_free_bodies_agree_at_rest) {
  expect_free_bodies_at_rest(hanging_rsrrp(ClosureModel::cut));
  Linkage soft = hanging_rsrrp(ClosureModel::sde);
  soft.closures[0].sde.axes = SdeAxes::first;  // one point for both wrenches
  expect_free_bodies_at_rest(soft);
  Linkage held = hanging_rsrrp(ClosureModel::cut);
  held.joints[0].hold = true;
  expect_free_bodies_at_rest(held);
  expect_free_bodies_at_rest(von_mises_truss(50.0));
}

TEST(StaticReactions, A_held_block_on_an_incline_stays_and_its_hold_bears_the_slope) {
  const double slope = 20.0 * M_PI / 180;
  Linkage linkage = block_on_incline(slope);
  linkage.joints[0].hold = true;
  linkage.joints[0].position = {0.4};
  const Rest rest = rest_of(linkage);
  ASSERT_TRUE(rest.report.converged);
  EXPECT_EQ(rest.state.q[PositionIndex(0)], 0.4);
  EXPECT_EQ(rest.report.directions, 0);
  EXPECT_EQ(rest.report.stability, Stability::stable);
  EXPECT_NEAR(rest.report.holding[0], 2.0 * kGravity * std::sin(slope), 1e-12);
  const Vector force = values_of(rest, {"joint.rail.force"});
  EXPECT_TRUE(
      near_absolute(force, 2.0 * kGravity * Vector3d(-std::cos(slope), 0, std::sin(slope)), 1e-10));
}

TEST(StaticReactions, A_free_block_on_an_incline_is_told_that_nothing_holds_it) {
  const Rest rest = rest_of(block_on_incline(20.0 * M_PI / 180));
  EXPECT_FALSE(rest.report.converged);
  EXPECT_THAT(rest.report.reason, HasSubstr("nothing holds against 6.71 N at joint.rail"));
  EXPECT_THAT(rest.report.reason, HasSubstr("friction is left out"));
}

// The torque on a held crank is the slope of the weight's potential along the closed form.
TEST(StaticReactions, A_held_crank_bears_the_slope_of_the_potential) {
  const auto height = [](double psi) {
    Linkage at = rsrrp();
    const RsrrpPose p = rsrrp_pose(psi);
    for (std::size_t k = 0; k < 4; ++k) {
      at.joints[k].position = {std::array{p.psi, p.d, p.psi22, p.psi23}[k]};
    }
    return EngineProbe(at).at("energy.potential");
  };
  Linkage linkage = hanging_rsrrp(ClosureModel::cut);
  linkage.joints[0].hold = true;
  const Rest rest = rest_of(linkage);
  ASSERT_TRUE(rest.report.converged);
  const double h = 1e-4;
  const double slope = (height(2.9 + h) - height(2.9 - h)) / (2 * h);
  EXPECT_GT(std::abs(slope), 0.1);
  EXPECT_NEAR(rest.report.holding[0], slope, 1e-6);
}

TEST(StaticReactions, A_platform_on_springs_rests_without_alarm_and_idle_legs_are_counted) {
  const Rest firm = rest_of(resting_platform(false));
  ASSERT_TRUE(firm.report.converged) << firm.report.reason;
  EXPECT_EQ(firm.report.stability, Stability::stable);
  EXPECT_EQ(firm.report.directions, 6);
  EXPECT_EQ(firm.report.neutral, 0);
  const Rest idle = rest_of(resting_platform(true));
  ASSERT_TRUE(idle.report.converged) << idle.report.reason;
  EXPECT_EQ(idle.report.stability, Stability::neutral);
  EXPECT_EQ(idle.report.directions, 12);
  EXPECT_EQ(idle.report.neutral, 6);
  EXPECT_GT(idle.report.smallest_beyond, 1.0);
  for (const int leg : {1, 2, 3, 4, 5, 6}) {
    const std::string p = "joint.P" + std::to_string(leg) + ".q";
    EXPECT_NEAR(values_of(idle, {p})[0], values_of(firm, {p})[0], 1e-9) << p;
  }
}

// Each leg bears a sixth of the platform and half of its upper part at the top, and the upper
// part's weight along itself.
TEST(StaticReactions, A_held_platform_reports_the_thrust_of_its_legs) {
  Linkage linkage = resting_platform(true);
  for (Joint& joint : linkage.joints) {
    if (joint.type != JointType::prismatic) continue;
    joint.stiffness.clear();
    joint.hold = true;
  }
  const Rest rest = rest_of(linkage);
  ASSERT_TRUE(rest.report.converged) << rest.report.reason;
  EXPECT_EQ(rest.report.neutral, 6);
  EXPECT_EQ(rest.report.directions, 6);
  const double angle = 30.0 * M_PI / 180;  // between base and top of a leg, seen from above
  const Vector3d leg(0.6 * std::cos(angle) - 1.0, 0.6 * std::sin(angle), 1.1);
  const double c = 1.1 / leg.norm();
  const double thrust = (1.0 / 6.0 + 0.5) * kGravity / c + 0.5 * kGravity * c;
  for (const VelocityIndex k : rest.model.held) {
    EXPECT_NEAR(rest.report.holding[k.value()], thrust, 1e-9);
  }
}

TEST(StaticReactions, A_truss_below_its_limit_load_rests_where_the_closed_form_says) {
  const TrussData data;
  for (const double part : {0.3, 0.9, 0.999}) {
    const double force = part * truss_limit_load(data);
    const Rest rest = rest_of(von_mises_truss(force, data));
    ASSERT_TRUE(rest.report.converged) << part;
    EXPECT_EQ(rest.report.stability, Stability::stable) << part;
    const double height = truss_height(data, force, false);
    const double q = std::atan2(height, data.half_span);
    // Near the limit the height goes as the root of the load that is left over: 1e-9 of it.
    EXPECT_NEAR(rest.state.q[PositionIndex(0)], q, 1e-7) << part;
    EXPECT_NEAR(rest.state.q[PositionIndex(1)], std::hypot(data.half_span, height), 1e-7) << part;
    EXPECT_NEAR(values_of(rest, {"joint.A1.force"})[1], 0.5 * force, 1e-6);
  }
}

TEST(StaticReactions, A_truss_past_its_limit_load_rests_snapped_through) {
  const TrussData data;
  for (const double part : {1.001, 1.5, 4.0}) {
    const double force = part * truss_limit_load(data);
    const Rest rest = rest_of(von_mises_truss(force, data));
    ASSERT_TRUE(rest.report.converged) << part << rest.report.reason;
    EXPECT_EQ(rest.report.stability, Stability::stable) << part;
    const double height = truss_height(data, force, true);
    EXPECT_NEAR(rest.state.q[PositionIndex(1)], std::hypot(data.half_span, height), 1e-7) << part;
    EXPECT_GT(rest.report.displacement, 0.5);
  }
}

TEST(StaticReactions, The_smallest_stiffness_has_the_unit_of_what_can_move) {
  Linkage hung = mass_on_spring(2.5, 800.0);
  const Rest slides = rest_of(hung);
  EXPECT_EQ(slides.report.unit, StiffnessUnit::translation);
  EXPECT_NEAR(slides.report.smallest_stiffness, 800.0, 1e-4);
  Linkage swing = pendulum(2.0, 0.5);
  swing.joints[0].position = {-1.5};
  const Rest turns = rest_of(swing);
  EXPECT_EQ(turns.report.unit, StiffnessUnit::rotation);
  EXPECT_NEAR(turns.report.smallest_stiffness, 2.0 * kGravity * 0.5, 1e-6);
  // A cylindrical joint with a spring on each coordinate: translations over the extent L.
  Linkage both = mass_on_spring(1.0, 0.0);
  both.closures.clear();
  both.links[0].center_of_mass = {0.3, 0, 0};
  both.links[0].inertia = 0.01 * Eigen::Matrix3d::Identity();
  both.joints[0].type = JointType::cylindrical;
  both.joints[0].stiffness = {1e3, 40.0};
  const Rest mixed = rest_of(both);
  EXPECT_EQ(mixed.report.unit, StiffnessUnit::mixed);
  EXPECT_NEAR(mixed.report.extent, 0.3, 1e-12);
  EXPECT_NEAR(mixed.report.smallest_stiffness, 40.0 * 0.3 * 0.3, 1e-8);
}

}  // namespace linkstudy::testing::statics_reactions_test
