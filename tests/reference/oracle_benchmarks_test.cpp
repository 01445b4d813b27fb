// The oracle and the mechanism builders against published numbers and closed forms.
// Sources: IFToMM benchmark library of multibody dynamics (A01, A02, spatial rigid slider-crank).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/csv.h"
#include "tests/support/near.h"
#include "tests/support/source_file.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing::oracle_benchmarks_test {

TEST(OracleBenchmarks, The_pendulum_returns_after_its_period) {
  EXPECT_NEAR(pendulum_period(1.0, 9.81, M_PI / 2), kPendulumPeriod, 5e-10);
  const TraceModel model = make_trace_model(pendulum());
  const OracleState quarter = rk4(model, kPendulumPeriod / 4000, 1000, start_state(model));
  EXPECT_NEAR(quarter.q[0], -M_PI / 2, 5e-9);  // ten printed digits
  EXPECT_NEAR(quarter.v[0], -std::sqrt(2 * 9.81), 1e-9);
}

TEST(OracleBenchmarks, Two_square_four_bars_turn_in_the_published_time_past_singular_poses) {
  EXPECT_NEAR(n_four_bar_period(2), kTwoFourBarPeriod, 5e-10);
  const TraceModel model = make_trace_model(n_four_bar(2));
  const OracleState start = start_state(model);
  EXPECT_LT(cut_constraints(model, start.q, start.v).value.norm(), 1e-15);
  EXPECT_TRUE(oracle_acceleration(model, 0.0, start.q, start.v).redundant);
  // Step counts whose stages stay 6e-4 rad and more away from the flat pose; a stage 2e-5 rad from
  // it (2000 steps) leaves the branch, because there three motions are possible.
  for (const int steps : {501, 1001, 2001}) {
    const OracleState end = rk4(model, kTwoFourBarPeriod / steps, steps, start);
    for (int rod = 0; rod < 3; ++rod) {
      EXPECT_NEAR(end.q[rod], start.q[rod] - 2 * M_PI, 2e-9) << steps;  // ten printed digits
      EXPECT_NEAR(end.v[rod], -1.0, 5e-9) << steps;
    }
  }
}

TEST(OracleBenchmarks, More_square_four_bars_follow_their_closed_form) {
  const double period = n_four_bar_period(5);
  const TraceModel model = make_trace_model(n_four_bar(5));
  const OracleState start = start_state(model);
  const OracleState end = rk4(model, period / 1000, 200, start);  // a fifth, before the rods lie
  const double theta = end.q[0] - M_PI / 2;
  const double inertia = 6 / 3.0 + 5, weight = 9.81 * (6 / 2.0 + 5);
  EXPECT_NEAR(end.v[0] * end.v[0], 1 + 2 * weight / inertia * (1 - std::cos(theta)), 1e-8);
}

TEST(OracleBenchmarks, The_four_bar_stays_on_its_closed_form_and_keeps_its_energy) {
  const TraceModel model = make_trace_model(four_bar());
  OracleState state = start_state(model);
  const double energy = total_energy(model, state);
  const Constraints c = cut_constraints(model, state.q, state.v);
  EXPECT_LT(c.value.norm(), 1e-15);
  EXPECT_LT((c.jacobian * state.v).norm(), 1e-14);
  for (int k = 0; k < 20; ++k) {
    state = rk4(model, 2e-4, 100, state);
    const FourBarPose pose = four_bar_pose(state.q[0], state.v[0]);
    EXPECT_NEAR(state.q[1], pose.coupler - pose.crank, 1e-8);
    EXPECT_NEAR(state.q[2], pose.rocker, 1e-8);
    EXPECT_NEAR(state.v[2], pose.rocker_rate, 1e-7);
    EXPECT_NEAR(total_energy(model, state), energy, 1e-8);
  }
  EXPECT_GT(std::abs(state.q[0] - model.q0[0]), 0.5);
}

TEST(OracleBenchmarks, The_spatial_slider_crank_starts_with_the_published_energy) {
  for (const Linkage& linkage : {spatial_slider_crank(), spatial_slider_crank_cut_at_universal()}) {
    const TraceModel model = make_trace_model(linkage);
    const OracleState start = start_state(model);
    const Constraints c = cut_constraints(model, start.q, start.v);
    EXPECT_LT(c.value.norm(), 1e-15) << linkage.name;
    EXPECT_LT((c.jacobian * start.v).norm(), 1e-14) << linkage.name;
    EXPECT_NEAR(total_energy(model, start), kSpatialSliderCrankEnergy, 5e-9) << linkage.name;
  }
}

TEST(OracleBenchmarks, The_spatial_slider_crank_follows_the_published_series) {
  const Csv published = read_csv(source_file("tests/reference/spatial_slider_crank_gonzalez.csv"));
  const std::vector<double>& t = published.column("t_s");
  const std::vector<double>& x = published.column("x_slider_m");
  ASSERT_EQ(t.size(), 501u);
  const TraceModel at_S = make_trace_model(spatial_slider_crank());
  const int slider_S = coordinate_index(at_S, "P");
  OracleState S = start_state(at_S);
  const double energy = total_energy(at_S, S);
  for (std::size_t k = 0; k < t.size(); ++k) {
    ASSERT_NEAR(S.t, t[k], 1e-12);
    EXPECT_NEAR(S.q[slider_S], x[k], 1e-4) << "at t = " << t[k];
    S = rk4(at_S, 5e-4, 20, S);
  }
  EXPECT_NEAR(total_energy(at_S, S), energy, 1e-6);
}

TEST(OracleBenchmarks, Both_cuts_of_the_spatial_slider_crank_move_alike) {
  const TraceModel at_S = make_trace_model(spatial_slider_crank());
  const TraceModel at_U = make_trace_model(spatial_slider_crank_cut_at_universal());
  const auto apart = [&](double h, long steps) {
    const OracleState S = rk4(at_S, h, steps, start_state(at_S));
    const OracleState U = rk4(at_U, h, steps, start_state(at_U));
    return std::abs(U.q[coordinate_index(at_U, "P")] - S.q[coordinate_index(at_S, "P")]);
  };
  const double coarse = apart(1e-3, 400);
  const double fine = apart(5e-4, 800);
  EXPECT_LT(coarse, 2e-7);
  EXPECT_NEAR(coarse / fine, 16.0, 2.0) << "they differ by the fourth order of the step only";
}

}  // namespace linkstudy::testing::oracle_benchmarks_test
