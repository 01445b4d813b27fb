// The engine against published numbers and closed forms: test vectors of the RSRRP linkage, IFToMM
// benchmarks, slider position over a full turn.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/mechanisms/four_bar.h"
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
    EXPECT_NEAR(end.final_state.q[k], expected[k], 1e-12 * (k == 0 ? 10 : 1)) << k;
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
  EXPECT_GT(end.final_state.q[0], 20 * M_PI) << "the crank turns all the while";
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
    EXPECT_EQ(p.model.start.q[0], pose.psi);
    EXPECT_NEAR(p.model.start.q[1], pose.d, 1e-8) << k;  // residual 1e-9 over the closure's slope
    EXPECT_NEAR(p.model.start.q[2], pose.psi22, 1e-8) << k;
    EXPECT_NEAR(p.model.start.q[3], pose.psi23, 1e-8) << k;
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
  EXPECT_NEAR(quarter.final_state.q[0], -M_PI / 2, 5e-9);  // ten printed digits of the period
  EXPECT_NEAR(quarter.final_state.v[0], -std::sqrt(2 * 9.81), 1e-9);
  const SimulationOutcome whole = run(model, steps_of(kPendulumPeriod / 4000, kPendulumPeriod));
  EXPECT_NEAR(whole.final_state.q[0], 0.0, 1e-8);
  EXPECT_NEAR(whole.final_state.v[0], 0.0, 2e-8);  // g / L times 5e-10 s of the printed period
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
      if (model.mechanism.joint_names[b][0] != 'A') continue;
      const auto q = static_cast<std::size_t>(model.mechanism.bodies[b].q_begin);
      EXPECT_NEAR(end.final_state.q[q], M_PI / 2 - 2 * M_PI, 2e-9) << steps;
      EXPECT_NEAR(end.final_state.v[q], -1.0, 5e-9) << steps;
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

}  // namespace linkstudy::testing::engine_benchmarks_test
