// Static equilibria against closed forms, and their stability.
#include "core/dynamics/statics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/mass_on_spring.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::statics_test {
namespace {

using Eigen::Vector3d;

struct Equilibrium {
  Model model;
  State<double> state;
  StaticsReport report;
};

Equilibrium equilibrium_of(const Linkage& linkage, double t = 0.0) {
  Equilibrium e{compile(linkage), {}, {}};
  e.state = e.model.start;
  e.state.t = t;
  e.report = solve_statics(e.model, e.state);
  return e;
}

Linkage pendulum_at(double angle) {
  Linkage linkage = pendulum(2.0, 0.5);
  linkage.joints[0].position = {angle};
  return linkage;
}

Linkage hanging_mass(double mass, double stiffness) {
  Linkage linkage = mass_on_spring(mass, stiffness);
  linkage.gravity = Vector3d(0, 0, -9.81);
  return linkage;
}

// The linkage with its crank at psi and all else where that belongs.
Linkage rsrrp_at(double psi) {
  Linkage linkage = rsrrp();
  const RsrrpPose start = rsrrp_pose(psi);
  for (std::size_t k = 0; k < 4; ++k) {
    linkage.joints[k].position = {std::array{start.psi, start.d, start.psi22, start.psi23}[k]};
  }
  return linkage;
}

// The same with the spherical joint replaced by a spring of stiffness c.
Linkage replaced_at(double psi, double c) {
  Linkage linkage = rsrrp_at(psi);
  linkage.closures[0].model = ClosureModel::sde;
  linkage.closures[0].sde.stiffness = {c, c, c, 0, 0, 0};
  return linkage;
}

// Largest acceleration from rest there: the residual by another route.
double acceleration_at(const Linkage& linkage, const State<double>& s) {
  EngineProbe engine(linkage);
  engine.evaluate_at(s);
  return engine.qdd().lpNorm<Eigen::Infinity>();
}

}  // namespace

TEST(Statics, A_pendulum_hangs_straight_down_and_is_stable) {
  const Linkage linkage = pendulum_at(-M_PI / 2 + 0.7);
  const Equilibrium e = equilibrium_of(linkage);
  ASSERT_TRUE(e.report.converged);
  EXPECT_NEAR(e.state.q[PositionIndex(0)], -M_PI / 2, 1e-9);
  EXPECT_EQ(e.report.stability, Stability::stable);
  EXPECT_NEAR(e.report.smallest_stiffness, 2.0 * 9.81 * 0.5, 1e-6);  // m g L
  EXPECT_NEAR(e.report.displacement, 0.7, 1e-9);
  EXPECT_LT(e.report.force_residual, 1e-7);
  EXPECT_GT(e.report.iterations, 1);
}

TEST(Statics, An_inverted_pendulum_stands_and_is_unstable) {
  const Equilibrium e = equilibrium_of(pendulum_at(M_PI / 2 - 0.2));
  ASSERT_TRUE(e.report.converged);
  EXPECT_NEAR(e.state.q[PositionIndex(0)], M_PI / 2, 1e-9);
  EXPECT_EQ(e.report.stability, Stability::unstable);
  EXPECT_NEAR(e.report.smallest_stiffness, -2.0 * 9.81 * 0.5, 1e-6);
}

TEST(Statics, A_pendulum_without_weight_rests_anywhere) {
  Linkage linkage = pendulum_at(0.3);
  linkage.gravity = Vector3d(0, 0, -9.81);  // along its axis
  const Equilibrium e = equilibrium_of(linkage);
  ASSERT_TRUE(e.report.converged);
  EXPECT_EQ(e.state.q[PositionIndex(0)], 0.3);
  EXPECT_EQ(e.report.stability, Stability::neutral);
}

TEST(Statics, A_mass_stretches_its_spring_by_its_weight) {
  const Equilibrium e = equilibrium_of(hanging_mass(2.5, 800.0));
  ASSERT_TRUE(e.report.converged);
  EXPECT_NEAR(e.state.q[PositionIndex(0)], -2.5 * 9.81 / 800.0, 1e-10);
  EXPECT_EQ(e.report.stability, Stability::stable);
  EXPECT_NEAR(e.report.smallest_stiffness, 800.0, 1e-4);
  EngineProbe engine(hanging_mass(2.5, 800.0));
  engine.evaluate_at(e.state);
  EXPECT_NEAR(engine.at("closure.spring.force.z"), 2.5 * 9.81, 1e-7);
}

TEST(Statics, A_falling_mass_has_no_equilibrium_and_keeps_its_state) {
  const Equilibrium e = equilibrium_of(hanging_mass(2.5, 0.0));
  EXPECT_FALSE(e.report.converged);
  EXPECT_NEAR(e.report.force_residual, 2.5 * 9.81, 1e-9);
  EXPECT_EQ(e.state.q[PositionIndex(0)], 0.0);
}

// One freedom: the potential energy along the closed form is stationary there. Found without the
// engine, by bisection on its slope.
TEST(Statics, The_cut_linkage_rests_where_its_closed_potential_is_stationary) {
  const Linkage linkage = rsrrp_at(2.6);
  const Equilibrium e = equilibrium_of(linkage);
  ASSERT_TRUE(e.report.converged);
  EXPECT_EQ(e.report.stability, Stability::stable);
  // Heights: crank's centre 0.05 cos psi; the coupler's centre halfway between pin and tip.
  EXPECT_NEAR(std::cos(e.state.q[PositionIndex(0)]), -1.0, 1e-12)
      << "all centres are lowest at the bottom";
  EXPECT_LT(e.report.closure_residual, 1e-9);
  EXPECT_LT(acceleration_at(linkage, e.state), 1e-5);
  const RsrrpPose bottom = rsrrp_pose(M_PI);
  EXPECT_NEAR(e.state.q[PositionIndex(1)], bottom.d, 1e-8);
}

TEST(Statics, A_stiff_replacement_rests_where_the_cut_joint_does_with_the_same_force) {
  const Linkage cut = rsrrp_at(2.9);
  Linkage sde = cut;
  sde.closures[0].model = ClosureModel::sde;
  const Equilibrium exact = equilibrium_of(cut);
  ASSERT_TRUE(exact.report.converged);
  double last = 0.0;
  for (const double c : {1e5, 1e6}) {
    sde.closures[0].sde.stiffness = {c, c, c, 0, 0, 0};
    const Equilibrium soft = equilibrium_of(sde);
    ASSERT_TRUE(soft.report.converged);
    EXPECT_EQ(soft.report.stability, exact.report.stability);
    EngineProbe probe(sde);
    probe.evaluate_at(soft.state);
    const Vector3d force = probe.vector("closure.S.force");
    EXPECT_TRUE(near_relative(force, Vector3d(exact.report.multipliers), 20.0 / c * 100));
    double apart = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      apart = std::max(apart,
                       std::abs(soft.state.q[PositionIndex(k)] - exact.state.q[PositionIndex(k)]));
    }
    EXPECT_LT(apart, 100.0 / c);  // some ten newtons over c, and levers
    if (last > 0.0) {
      EXPECT_NEAR(last / apart, 10.0, 0.5);
    }
    last = apart;
  }
}

// At the bottom the weights hold the crank, at the top they throw it over, and without them nothing
// does either: however stiff the replacement is.
TEST(Statics, The_verdict_on_stability_does_not_depend_on_the_stiffness_of_the_replacement) {
  const Equilibrium hanging = equilibrium_of(rsrrp_at(2.9));
  const Equilibrium standing = equilibrium_of(rsrrp_at(0.1));
  ASSERT_EQ(hanging.report.stability, Stability::stable);
  ASSERT_EQ(standing.report.stability, Stability::unstable);
  for (const double c : {1e6, 1e7, 1e8, 1e9, 1e10}) {
    const Equilibrium stable = equilibrium_of(replaced_at(2.9, c));
    ASSERT_TRUE(stable.report.converged) << c;
    EXPECT_EQ(stable.report.stability, Stability::stable) << c;
    const double k = hanging.report.smallest_stiffness;
    EXPECT_NEAR(stable.report.smallest_stiffness, k, k * (1e-2 + 1e4 / c)) << c;
    const Equilibrium unstable = equilibrium_of(replaced_at(0.1, c));
    ASSERT_TRUE(unstable.report.converged) << c;
    EXPECT_EQ(unstable.report.stability, Stability::unstable) << c;
    Linkage weightless = replaced_at(2.9, c);
    weightless.gravity.setZero();
    const Equilibrium neutral = equilibrium_of(weightless);
    ASSERT_TRUE(neutral.report.converged) << c;
    EXPECT_EQ(neutral.report.stability, Stability::neutral) << c;
  }
}

TEST(Statics, A_linkage_far_from_the_origin_rests_as_it_does_at_home) {
  const Equilibrium home = equilibrium_of(replaced_at(2.9, 1e8));
  Linkage away = replaced_at(2.9, 1e8);
  for (Joint& joint : away.joints) {
    if (joint.parent == kGround) joint.frame.position += Vector3d(7e3, -5e3, 9e3);
  }
  const Equilibrium far = equilibrium_of(away);
  ASSERT_TRUE(home.report.converged);
  ASSERT_TRUE(far.report.converged) << far.report.force_residual;
  EXPECT_LT(far.report.force_residual, 1e-2);  // 1e8 N/m times the rounding of 1e4 m
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(far.state.q[PositionIndex(k)], home.state.q[PositionIndex(k)], 1e-2);
  EXPECT_NEAR(far.state.q[PositionIndex(1)], home.state.q[PositionIndex(1)], 1e-4);
}

TEST(Statics, A_strong_resistance_does_not_blunt_the_search) {
  Linkage linkage = pendulum_at(-M_PI / 2 + 0.7);
  Load brake;
  brake.name = "brake";
  brake.type = LoadType::resistance;
  brake.joint = linkage.joints[0].name;
  brake.law = {ResistanceShape::linear, 1e12, 1.0};
  linkage.loads = {brake};
  const Equilibrium e = equilibrium_of(linkage);
  ASSERT_TRUE(e.report.converged);
  EXPECT_NEAR(e.state.q[PositionIndex(0)], -M_PI / 2, 1e-9);
}

TEST(Statics, A_drive_counts_with_its_value_at_the_time_of_the_state) {
  Linkage linkage = pendulum_at(-M_PI / 2 + 0.7);
  Load drive;
  drive.name = "drive";
  drive.joint = linkage.joints[0].name;
  drive.course = {CourseShape::table, 0.0, 0.0, {0.0, 1.0, 3.0}, {1e12, 4.0, 6.0}};
  linkage.loads = {drive};
  const Equilibrium e = equilibrium_of(linkage, 2.0);
  ASSERT_TRUE(e.report.converged);
  EXPECT_NEAR(e.state.q[PositionIndex(0)], -M_PI / 2 + std::asin(5.0 / (2.0 * 9.81 * 0.5)), 1e-9);
}

TEST(Statics, A_planar_four_bar_with_redundant_rows_finds_its_rest) {
  const Equilibrium e = equilibrium_of(four_bar());
  ASSERT_TRUE(e.report.converged);
  EXPECT_LT(acceleration_at(four_bar(), e.state), 1e-5);
  EXPECT_LT(e.report.closure_residual, 1e-9);
}

// A lever of weight W with its centre at r, held by a spring without free length from `height`
// above the pivot to `arm` along it: with k height arm = W r it rests at every angle.
TEST(Statics, A_lever_on_a_spring_without_free_length_rests_at_every_angle) {
  const double height = 0.6, arm = 0.3, weight = 2.0 * 9.81, r = 0.5;
  for (const double angle : {-1.2, -0.3, 0.4, 1.3}) {
    Linkage lever = pendulum_at(angle);  // 2 kg at 0.5 m, gravity along -y
    PointSpring spring;
    spring.name = "S";
    spring.first = {kGround, {0.0, height, 0.0}};
    spring.second = {"rod", {arm, 0.0, 0.0}};
    spring.stiffness = weight * r / (height * arm);
    spring.free_length = 0.0;
    lever.springs = {spring};
    const Equilibrium e = equilibrium_of(lever);
    ASSERT_TRUE(e.report.converged);
    EXPECT_NEAR(e.state.q[PositionIndex(0)], angle, 1e-9);
    EXPECT_EQ(e.report.stability, Stability::neutral);
    EXPECT_NEAR(e.report.smallest_stiffness, 0.0, 1e-8);
  }
}

// The same lever level, on a strut below it: k (l - l_0) times its lever bears the weight, and the
// stiffness is k lever^2 less what the force turns away by.
TEST(Statics, A_lever_on_a_strut_has_the_stiffness_of_its_closed_form) {
  const double arm = 0.4, below = 0.3, out = 0.1, weight = 2.0 * 9.81, r = 0.5, k = 5000.0;
  const Vector3d foot(arm + out, -below, 0.0);
  const double length = std::hypot(out, below);
  const double lever = arm * below / length;  // of the line about the pivot
  const double force = weight * r / lever;    // pushes
  Linkage linkage = pendulum_at(0.005);       // the strut is pressed there
  PointSpring strut;
  strut.name = "strut";
  strut.first = {kGround, foot};
  strut.second = {"rod", {arm, 0.0, 0.0}};
  strut.stiffness = k;
  strut.free_length = length + force / k;
  for (const SpringActs acts : {SpringActs::both, SpringActs::compression}) {
    strut.acts = acts;
    linkage.springs = {strut};
    const Equilibrium e = equilibrium_of(linkage);
    ASSERT_TRUE(e.report.converged);
    EXPECT_NEAR(e.state.q[PositionIndex(0)], 0.0, 1e-10);
    // V = k/2 (l - l_0)^2 + W r sin q with l^2 = a^2 + f^2 - 2 a f cos(q - phi), f, phi of the
    // foot: l l' = a f sin(q - phi), l'^2 + l l'' = a f cos(q - phi).
    const double af = arm * foot.norm(), phi = std::atan2(foot.y(), foot.x());
    const double l1 = af * std::sin(-phi) / length;
    const double l2 = (af * std::cos(phi) - l1 * l1) / length;
    EXPECT_NEAR(l1, lever, 1e-12);
    EXPECT_NEAR(e.report.smallest_stiffness, k * l1 * l1 - force * l2, 1e-6);
    EXPECT_EQ(e.report.stability, Stability::stable);
  }
}

// A rope from both sides, one of them slack; the table of the other bends 0.1 mm away from where
// it rests, which differences over a thousandth of the mechanism would not see.
TEST(Statics, Springs_that_bend_count_with_the_slope_where_they_rest) {
  Linkage linkage = hanging_mass(1.0, 0.0);
  linkage.closures.clear();
  PointSpring slack;
  slack.name = "slack";
  slack.first = {kGround, {0.0, 0.0, -1.0}};
  slack.second = {"mass", Vector3d::Zero()};
  slack.acts = SpringActs::tension;
  slack.stiffness = 1e5;
  slack.free_length = 2.0;
  PointSpring table = slack;
  table.name = "table";
  table.first.position = {0.0, 0.0, 1.0};
  table.stiffness = 0.0;
  table.free_length.reset();
  table.force = ForceCurve{{1.0, 1.1, 1.1002, 2.0}, {0.0, 9.0, 11.0, 12.0}};
  linkage.springs = {slack, table};
  linkage.joints[0].position = {-0.10015};
  const Equilibrium e = equilibrium_of(linkage);
  ASSERT_TRUE(e.report.converged);
  EXPECT_NEAR(e.state.q[PositionIndex(0)], -(0.1 + 0.0002 * (9.81 - 9.0) / 2.0), 1e-12);
  EXPECT_NEAR(e.report.smallest_stiffness, 2.0 / 0.0002, 1e-6);
}

}  // namespace linkstudy::testing::statics_test
