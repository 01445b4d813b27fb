// The engine against published numbers and closed forms: test vectors of the RSRRP linkage, IFToMM
// benchmarks, slider position over a full turn.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/csv.h"
#include "tests/support/engine_probe.h"
#include "tests/support/random.h"
#include "tests/support/source_file.h"

namespace linkstudy::testing::engine_benchmarks_test {
namespace {

void expect_test_vector(ClosureModel model, const std::array<double, 4>& expected) {
  const Model compiled = compile(rsrrp_test_vector(model));
  const SimulationOutcome end = run(compiled, steps_of(1e-4, 1.0));
  ASSERT_EQ(end.cause, Cause::ok);
  EXPECT_EQ(end.steps, 10000);
  // Twelve printed digits; rounding over 10000 steps stays below the last of them.
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(end.final_state.q[PositionIndex(k)], expected[k], 1e-12 * (k == 0 ? 10 : 1)) << k;
  }
}

}  // namespace

TEST(EngineRsrrp, The_spring_reaches_its_test_vector_after_one_second) {
  expect_test_vector(ClosureModel::sde,
                     {1.21258149373, 0.325199964329, 0.249158236958, -0.862682573037});
}

TEST(EngineRsrrp, The_cut_joint_reaches_its_test_vector_after_one_second) {
  expect_test_vector(ClosureModel::cut,
                     {1.21258334078, 0.325194724846, 0.249153192456, -0.862699299507});
}

TEST(EngineRsrrp, The_cut_joint_opens_less_than_a_micrometre_in_fifteen_seconds_unstabilised) {
  const SimulationOutcome end = run(compile(rsrrp()), steps_of(1e-4, 15.0));
  ASSERT_EQ(end.cause, Cause::ok);
  EXPECT_LT(end.drift_max, 1e-6);  // [Urbas16] sec. 5
  EXPECT_GT(end.drift_max, 0.0);
  EXPECT_GT(end.final_state.q[PositionIndex(0)], 20 * M_PI) << "the crank turns all the while";
}

TEST(EngineRsrrp, The_slider_follows_its_closed_form_over_many_turns) {
  const Samples s =
      run(compile(rsrrp()), steps_of(1e-4, 15.0, 1e-2), {"joint.A.q", "joint.P.q", "joint.Q.q"});
  ASSERT_EQ(s.values.rows(), 1501);
  for (Eigen::Index k = 0; k < s.values.rows(); ++k) {
    const RsrrpPose pose = rsrrp_pose(s.values(k, 0));
    // The drift of the cut, times the lever of the coupler at its steepest.
    EXPECT_NEAR(s.values(k, 1), pose.d, 3e-6) << k;
    EXPECT_NEAR(s.values(k, 2), pose.psi22, 1e-5) << k;
  }
}

TEST(EngineRsrrp, Wrong_starts_assemble_to_the_closed_form_over_a_full_turn) {
  Random random(5);
  for (int k = 0; k < 120; ++k) {
    const RsrrpPose pose = rsrrp_pose(3.0 * k * M_PI / 180);
    Linkage linkage = rsrrp();
    linkage.joints[0].position = {pose.psi};
    linkage.joints[0].hold = true;
    linkage.joints[1].position = {pose.d + random.within(0.08)};
    linkage.joints[2].position = {pose.psi22 + random.within(0.2)};
    linkage.joints[3].position = {pose.psi23 + random.within(0.2)};
    const Preparation p = prepare(linkage, steps_of(1e-4, 1.0));
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    EXPECT_EQ(p.model.start.q[PositionIndex(0)], pose.psi);
    EXPECT_NEAR(p.model.start.q[PositionIndex(1)], pose.d, 1e-8)
        << k;  // residual 1e-9 over the closure's slope
    EXPECT_NEAR(p.model.start.q[PositionIndex(2)], pose.psi22, 1e-8) << k;
    EXPECT_NEAR(p.model.start.q[PositionIndex(3)], pose.psi23, 1e-8) << k;
  }
}

TEST(EngineRsrrp, Both_cuts_of_the_linkage_move_alike) {
  const Samples S = run(compile(rsrrp()), steps_of(1e-4, 2.0, 0.1), {"joint.A.q", "joint.P.q"});
  const Samples R =
      run(compile(rsrrp_revolute()), steps_of(1e-4, 2.0, 0.1), {"joint.A.q", "joint.P.q"});
  EXPECT_LT((S.values - R.values).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(EngineRsrrp, The_cut_closure_force_is_the_reaction_of_the_other_cut) {
  const Samples S = run(compile(rsrrp()), steps_of(1e-4, 2.0, 0.1), {"closure.S.force"});
  const Samples R = run(compile(rsrrp_revolute()), steps_of(1e-4, 2.0, 0.1), {"joint.S.force"});
  // The closure acts on the crank, the reaction on the coupler.
  EXPECT_LT((S.values + R.values).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_GT(S.values.cwiseAbs().maxCoeff(), 5.0);
}

TEST(EngineBenchmarks, The_pendulum_returns_after_its_period) {
  const Model model = compile(pendulum());
  const SimulationOutcome quarter =
      run(model, steps_of(kPendulumPeriod / 4000, kPendulumPeriod / 4));
  EXPECT_NEAR(quarter.final_state.q[PositionIndex(0)], -M_PI / 2,
              5e-9);  // ten printed digits of the period
  EXPECT_NEAR(quarter.final_state.v[VelocityIndex(0)], -std::sqrt(2 * 9.81), 1e-9);
  const SimulationOutcome whole = run(model, steps_of(kPendulumPeriod / 4000, kPendulumPeriod));
  EXPECT_NEAR(whole.final_state.q[PositionIndex(0)], 0.0, 1e-8);
  EXPECT_NEAR(whole.final_state.v[VelocityIndex(0)], 0.0,
              2e-8);  // g / L times 5e-10 s of the printed period
}

TEST(EngineBenchmarks, Two_square_four_bars_turn_in_the_published_time_past_singular_poses) {
  const Model model = compile(n_four_bar(2));
  // Step counts whose stages stay 6e-4 rad and more away from the flat pose: nearer to it three
  // motions are possible and rounding chooses among them.
  for (const int steps : {501, 1001, 2001}) {
    const SimulationOutcome end =
        run(model, steps_of(kTwoFourBarPeriod / steps, kTwoFourBarPeriod));
    ASSERT_EQ(end.cause, Cause::ok) << end.message;
    EXPECT_TRUE(end.redundant);
    for (std::size_t b = 1; b < model.mechanism.bodies.size(); ++b) {
      if (model.mechanism.joint_names[BodyIndex(b)][0] != 'A') continue;
      const Body& link = model.mechanism.bodies[BodyIndex(b)];
      EXPECT_NEAR(end.final_state.q[link.q_begin], M_PI / 2 - 2 * M_PI, 2e-9) << steps;
      EXPECT_NEAR(end.final_state.v[link.v_begin], -1.0, 5e-9) << steps;
    }
  }
}

TEST(EngineBenchmarks, The_four_bar_stays_on_its_closed_form) {
  const Samples s = run(compile(four_bar()), steps_of(1e-4, 2.0, 0.05),
                        {"joint.A.q", "joint.A.v", "joint.B.q", "joint.D.q", "joint.D.v"});
  for (Eigen::Index k = 0; k < s.values.rows(); ++k) {
    const FourBarPose pose = four_bar_pose(s.values(k, 0), s.values(k, 1));
    EXPECT_NEAR(s.values(k, 2), pose.coupler - pose.crank, 1e-7) << k;
    EXPECT_NEAR(s.values(k, 3), pose.rocker, 1e-7) << k;
    EXPECT_NEAR(s.values(k, 4), pose.rocker_rate, 1e-6) << k;
  }
}

TEST(EngineBenchmarks, The_spatial_slider_crank_follows_the_published_series_with_its_energy) {
  const Csv published = read_csv(source_file("tests/reference/spatial_slider_crank_gonzalez.csv"));
  const std::vector<double>& x = published.column("x_slider_m");
  for (const Linkage& linkage : {spatial_slider_crank(), spatial_slider_crank_cut_at_universal()}) {
    const Samples s = run(compile(linkage), steps_of(2.5e-4, 5.0, 1e-2),
                          {"joint.P.q", "energy.kinetic", "energy.potential"});
    ASSERT_EQ(s.values.rows(), static_cast<Eigen::Index>(x.size()));
    EXPECT_NEAR(s.values(0, 1) + s.values(0, 2), kSpatialSliderCrankEnergy, 5e-9);
    for (Eigen::Index k = 0; k < s.values.rows(); ++k) {
      EXPECT_NEAR(s.values(k, 0), x[static_cast<std::size_t>(k)], 1e-4) << linkage.name << k;
      EXPECT_NEAR(s.values(k, 1) + s.values(k, 2), kSpatialSliderCrankEnergy, 1e-6) << k;
    }
  }
}

namespace {

// Seven plane links on pins along z; links in the order K1, K2, K3, K5, K4, K7, K6 (the data of the
// shipped file, in which every number has its source).
Linkage squeezer() {
  const Eigen::Matrix3d across = Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitY()).matrix();
  Linkage s;
  const auto add = [&](const std::string& joint, const std::string& parent,
                       const Eigen::Vector3d& at, double angle, const Link& link) {
    s.links.push_back(link);
    Frame frame;
    frame.position = at;
    s.joints.push_back(pivot_at(joint, parent, link.name, frame, angle, 0.0));
  };
  const auto link = [](const char* name, double mass, double x, double y, double inertia) {
    return Link{name, mass, {x, y, 0.0}, inertia * Eigen::Matrix3d::Identity(), {}};
  };
  add("O", kGround, {0, 0, 0}, -0.0617138900142764496, link("K1", 0.04325, 92e-5, 0, 2.194e-6));
  add("K2", "K1", {7e-3, 0, 0}, 0.0, link("K2", 0.00365, -115e-4, 0, 4.410e-7));
  add("B", kGround, {-0.03635, 0.03273, 0}, 0.455279819163070380,
      link("K3", 0.02373, 1874e-5, -1043e-5, 5.255e-6));
  add("A5", kGround, {-0.06934, -0.00227, 0}, 0.487364979543842550,
      link("K5", 0.07050, 2308e-5, 916e-5, 1.169e-5));
  add("E", "K5", {4e-2, 0, 0}, 0.222668390165885885, link("K4", 0.00706, 0, -579e-5, 5.667e-7));
  add("A7", kGround, {-0.06934, -0.00227, 0}, 1.23054744454982119,
      link("K7", 0.05498, 1228e-5, -449e-5, 1.912e-5));
  add("G", "K7", {0, -4e-2, 0}, -0.222668390165885885, link("K6", 0.00706, 579e-5, 0, 5.667e-7));
  const std::pair<const char*, Eigen::Vector3d> ends[] = {
      {"K3", {0, -35e-3, 0}}, {"K4", {0, -2e-2, 0}}, {"K6", {2e-2, 0, 0}}};
  for (const auto& [name, at] : ends) {
    Closure pin;
    pin.name = std::string("F") + name;
    pin.type = JointType::revolute;
    pin.stabilization = Stabilization::projection;
    pin.first = {"K2", {across, {-28e-3, 0, 0}}};
    pin.second = {name, {across, at}};
    s.closures.push_back(pin);
  }
  PointSpring spring;
  spring.name = "C";
  spring.first = {kGround, {0.014, 0.072, 0.0}};
  spring.second = {"K3", {2e-2, -18e-3, 0.0}};
  spring.stiffness = 4530.0;
  spring.free_length = 0.07785;
  s.springs = {spring};
  Load drive;
  drive.name = "drive";
  drive.joint = "O";
  drive.course = {CourseShape::constant, 0.033, 0.0, {}, {}};
  s.loads = {drive};
  return s;
}

}  // namespace

// IVP test set, Andrews' squeezing mechanism: angles after 0.03 s.
TEST(EngineSqueezer, Ends_at_the_angles_of_the_ivp_test_set) {
  SimulationOptions options = steps_of(1e-4, 0.03);
  options.integrator = Integrator::adaptive;
  options.relative_tolerance = 1e-12;
  options.absolute_tolerance = 1e-13;
  const Preparation p = prepare(squeezer(), options);
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  const SimulationOutcome end = run(p.model, options);
  ASSERT_EQ(end.cause, Cause::ok) << end.message;
  const std::pair<const char*, double> published[] = {
      {"O", 15.81077119629904}, {"K2", -15.75637105984298}, {"B", 0.04082224013073},
      {"E", -0.53473011632269}, {"A5", 0.52440996588053},   {"A7", 1.048080741042263},
      {"G", 0.534730116322690}};
  for (const auto& [joint, angle] : published) {
    const auto& names = p.model.mechanism.joint_names;
    const BodyIndex body(std::ranges::find(names, joint) - names.begin());
    const Body& link = p.model.mechanism.bodies[body];
    EXPECT_NEAR(end.final_state.q[link.q_begin], angle, 2e-9) << joint;  // of up to 16 rad
  }
  EXPECT_LT(end.energy_residual_max, 1e-9 * end.energy_scale);
}

}  // namespace linkstudy::testing::engine_benchmarks_test
