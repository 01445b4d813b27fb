// Runs: grid of steps, causes of their end, limits, observers, preparation.
#include "core/simulation/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>

#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::simulate_test {
namespace {

Linkage replaced_rsrrp(double stiffness) {
  Linkage linkage = rsrrp();
  linkage.closures[0].model = ClosureModel::sde;
  linkage.closures[0].sde.stiffness = {stiffness, stiffness, stiffness, 0, 0, 0};
  return linkage;
}

}  // namespace

TEST(StepGrid, Equal_steps_fill_the_run_exactly) {
  EXPECT_EQ(make_step_grid(steps_of(1e-4, 15.0)).count, 150000);
  EXPECT_EQ(make_step_grid(steps_of(1e-3, 0.3)).count, 300);
  const StepGrid uneven = make_step_grid(steps_of(0.3, 1.0));
  EXPECT_EQ(uneven.count, 4);
  EXPECT_DOUBLE_EQ(uneven.h, 0.25);
  EXPECT_EQ(make_step_grid(steps_of(5.0, 1.0)).count, 1);
}

TEST(Simulate, A_run_repeats_to_the_last_bit) {
  const Model model = compile(rsrrp());
  const SimulationOutcome a = run(model, steps_of(1e-3, 1.0));
  const SimulationOutcome b = run(model, steps_of(1e-3, 1.0));
  EXPECT_EQ(a.final_state.q, b.final_state.q);
  EXPECT_EQ(a.final_state.v, b.final_state.v);
}

TEST(Simulate, A_run_in_two_parts_is_the_run_in_one) {
  Model model = compile(rsrrp());
  const SimulationOutcome whole = run(model, steps_of(1e-3, 1.0));
  const SimulationOutcome half = run(model, steps_of(1e-3, 0.5));
  model.start = half.final_state;
  EXPECT_DOUBLE_EQ(model.start.t, 0.5);
  const SimulationOutcome rest = run(model, steps_of(1e-3, 0.5));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(rest.final_state.q[PositionIndex(k)], whole.final_state.q[PositionIndex(k)],
                1e-12);  // times differ by rounding
  }
}

TEST(Simulate, A_cut_that_opens_beyond_its_limit_ends_the_run_in_time) {
  SimulationOptions options = steps_of(1e-3, 15.0);
  options.drift_limit = 1e-8;
  const SimulationOutcome end = run(compile(rsrrp()), options);
  EXPECT_EQ(end.cause, Cause::constraint_drift);
  EXPECT_GT(end.drift_max, 1e-8);
  EXPECT_GT(end.end_time, 0.0);
  EXPECT_LT(end.end_time, 15.0);
  EXPECT_NEAR(end.end_time, static_cast<double>(end.steps) * 1e-3, 1e-12);
  EXPECT_NE(end.message.find("at t = "), std::string::npos);
}

TEST(Simulate, A_step_far_too_large_ends_in_a_typed_cause_and_not_in_an_exception) {
  const SimulationOutcome end = run(compile(replaced_rsrrp(1e8)), steps_of(1e-3, 15.0, 1e-2));
  EXPECT_TRUE(end.cause == Cause::diverged || end.cause == Cause::energy_blowup)
      << name_of(end.cause);
  EXPECT_LT(end.end_time, 1.0);
}

TEST(Simulate, An_undefined_start_has_diverged_at_once) {
  Model model = compile(pendulum());
  model.start.v[VelocityIndex(0)] = std::nan("");
  const SimulationOutcome end = run(model, steps_of(1e-3, 1.0));
  EXPECT_EQ(end.cause, Cause::diverged);
  EXPECT_EQ(end.steps, 0);
}

TEST(Simulate, A_cancelled_run_and_a_run_out_of_time_say_so) {
  const Model model = compile(rsrrp());
  const std::atomic<bool> cancelled = true;
  Observers none;
  RunLimits limits;
  limits.cancelled = &cancelled;
  const SimulationOptions options = steps_of(1e-4, 15.0);
  EXPECT_EQ(simulate(model.mechanism, model.parameters, model.start, options, none, limits).cause,
            Cause::cancelled);
  RunLimits hurried;
  hurried.timeout_s = 1e-9;
  EXPECT_EQ(simulate(model.mechanism, model.parameters, model.start, options, none, hurried).cause,
            Cause::timeout);
}

TEST(Observers, A_reduction_and_a_comparison_say_what_the_series_says) {
  const Model model = compile(rsrrp());
  const auto all = list_channels(model.mechanism);
  const auto force = find_channels(all, "closure.S.force");
  const Sampling window{100, 1000, 10};
  Observers first;
  first.series.push_back({force, window, {}});
  first.reductions.push_back({force[1], window, {}});
  first.reductions[0].place = {force[2]};
  const SimulationOptions options = steps_of(1e-4, 0.1);
  simulate(model.mechanism, model.parameters, model.start, options, first);
  const std::vector<double>& reference = first.series[0].values;
  ASSERT_EQ(first.series[0].rows(), 91u);
  const Model soft = compile(replaced_rsrrp(1e5));
  Observers second;
  second.series.push_back({force, window, {}});
  Comparison against;
  against.channels = force;
  against.sampling = window;
  against.reference = reference.data();
  against.sign = {1.0, 1.0, 1.0};
  second.comparisons.push_back(against);
  ASSERT_EQ(simulate(soft.mechanism, soft.parameters, soft.start, options, second).cause,
            Cause::ok);
  double low = 1e99, high = -1e99, sum = 0.0;
  std::size_t lowest = 0, highest = 0;  // values
  std::array<double, 3> worst{}, square{};
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const double e = second.series[0].values[k] - reference[k];
    worst[k % 3] = std::max(worst[k % 3], std::abs(e));
    const bool is_end = k < 3 || k + 3 >= reference.size();
    const double weight = is_end ? 0.5 : 1.0;  // trapezoidal rule
    square[k % 3] += weight * e * e;
    if (k % 3 != 1) continue;
    if (reference[k] < low) lowest = k;
    if (reference[k] > high) highest = k;
    low = std::min(low, reference[k]);
    high = std::max(high, reference[k]);
    sum += weight * reference[k];
  }
  EXPECT_EQ(first.reductions[0].min, low);
  EXPECT_EQ(first.reductions[0].max, high);
  EXPECT_EQ(first.reductions[0].min_step, 100 + 10 * static_cast<long>(lowest / 3));
  EXPECT_EQ(first.reductions[0].max_step, 100 + 10 * static_cast<long>(highest / 3));
  EXPECT_EQ(first.reductions[0].min_place, reference[lowest + 1]);
  EXPECT_EQ(first.reductions[0].max_place, reference[highest + 1]);
  EXPECT_NEAR(first.reductions[0].sum, sum, 1e-12 * std::abs(sum));
  EXPECT_EQ(first.reductions[0].seen, 91);
  EXPECT_EQ(second.comparisons[0].seen, 91);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(second.comparisons[0].max_error[i], worst[i], 1e-12 * worst[i]);
    EXPECT_NEAR(second.comparisons[0].square_error[i], square[i], 1e-12 * square[i]);
  }
}

TEST(Prepare, A_step_past_the_limit_and_a_coarse_step_are_warned_of) {
  const Preparation fine = prepare(replaced_rsrrp(1e5), steps_of(1e-4, 1.0));
  EXPECT_EQ(fine.cause, Cause::ok);
  EXPECT_EQ(fine.step_warning, "");
  const double limit = fine.spectrum.step_limit;
  EXPECT_GT(fine.spectrum.omega_max, 100.0);
  const Preparation past = prepare(replaced_rsrrp(1e5), steps_of(1.1 * limit, 10.0));
  EXPECT_THAT(past.step_warning, ::testing::HasSubstr("stability limit"));
  const double coarse = 1.3 / fine.spectrum.omega_max;
  if (coarse < limit) {
    const Preparation p = prepare(replaced_rsrrp(1e5), steps_of(coarse, 100.0 * coarse));
    EXPECT_THAT(p.step_warning, ::testing::HasSubstr("h omega_max"));
  }
}

TEST(Prepare, A_start_without_equilibrium_fails_in_statics) {
  Linkage linkage = rsrrp();
  linkage.links.push_back({"stone", 1.0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()});
  Joint fall;
  fall.name = "F";
  fall.type = JointType::free;
  fall.parent = kGround;
  fall.child = "stone";
  linkage.joints.push_back(fall);
  SimulationOptions options = steps_of(1e-4, 1.0);
  options.start = Start::equilibrium;
  const Preparation p = prepare(linkage, options);
  EXPECT_EQ(p.cause, Cause::statics_failed);
  EXPECT_NE(p.message.find("residual"), std::string::npos) << p.message;
}

TEST(Prepare, An_equilibrium_start_stays_where_it_is) {
  Linkage linkage = replaced_rsrrp(1e6);
  linkage.loads.clear();
  const RsrrpPose near_rest = rsrrp_pose(3.0);
  linkage.joints[0].position = {near_rest.psi};
  linkage.joints[1].position = {near_rest.d};
  linkage.joints[2].position = {near_rest.psi22};
  linkage.joints[3].position = {near_rest.psi23};
  SimulationOptions options = steps_of(1e-4, 0.5);
  options.start = Start::equilibrium;
  const Preparation p = prepare(linkage, options);
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  ASSERT_TRUE(p.statics.has_value());
  EXPECT_EQ(p.statics->stability, Stability::stable);
  const SimulationOutcome end = run(p.model, options);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(end.final_state.q[PositionIndex(k)], p.model.start.q[PositionIndex(k)],
                1e-8);  // residual force over stiffness
  }
}

}  // namespace linkstudy::testing::simulate_test
