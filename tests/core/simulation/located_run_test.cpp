// Runs by adaptive and stiff integrators without contacts: against constant steps, published
// series, closed forms; what ends them.
#include "core/simulation/located_run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "core/simulation/simulate.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/csv.h"
#include "tests/support/engine_probe.h"
#include "tests/support/source_file.h"
#include "tests/support/zyx_equivalent.h"

namespace linkstudy::testing::located_run_test {
namespace {

constexpr Integrator kAdaptive[] = {Integrator::adaptive, Integrator::stiff};

SimulationOptions by(Integrator integrator, double tolerance, SimulationOptions options) {
  options.integrator = integrator;
  options.relative_tolerance = options.absolute_tolerance = tolerance;
  return options;
}

Linkage replaced_rsrrp(double stiffness) {
  Linkage linkage = rsrrp();
  linkage.closures[0].model = ClosureModel::sde;
  linkage.closures[0].sde.stiffness = {stiffness, stiffness, stiffness, 0, 0, 0};
  return linkage;
}

Linkage projected_rsrrp() {
  Linkage linkage = rsrrp();
  linkage.closures[0].stabilization = Stabilization::projection;
  return linkage;
}

double distance(const State<double>& a, const State<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.q.size(); ++i)
    most = std::max(most, std::fabs(a.q[PositionIndex(i)] - b.q[PositionIndex(i)]));
  for (std::size_t i = 0; i < a.v.size(); ++i)
    most = std::max(most, std::fabs(a.v[VelocityIndex(i)] - b.v[VelocityIndex(i)]));
  return most;
}

}  // namespace

TEST(LocatedRun, It_ends_where_fine_constant_steps_end_with_fewer_evaluations) {
  for (const Linkage& linkage : {rsrrp(), projected_rsrrp(), replaced_rsrrp(1e5)}) {
    const Model model = compile(linkage);
    const SimulationOutcome fixed = run(model, steps_of(2e-5, 2.0));
    for (const Integrator integrator : kAdaptive) {
      const SimulationOutcome end = run(model, by(integrator, 1e-8, steps_of(1e-3, 2.0)));
      ASSERT_EQ(end.cause, Cause::ok) << end.message;
      EXPECT_EQ(end.end_time, 2.0);
      EXPECT_LT(distance(end.final_state, fixed.final_state), 1e-7);
      EXPECT_NEAR(end.final_state.supplied, fixed.final_state.supplied, 1e-6);
      EXPECT_NEAR(end.final_state.dissipated, fixed.final_state.dissipated, 1e-6);
      EXPECT_LT(3 * end.evaluations, fixed.evaluations);
      EXPECT_GE(end.evaluations, 6 * end.steps);
    }
  }
}

TEST(LocatedRun, Its_error_and_its_ledger_follow_the_tolerance) {
  const Model model = compile(rsrrp());
  const SimulationOutcome fixed = run(model, steps_of(2e-5, 2.0));
  for (const Integrator integrator : kAdaptive) {
    double error = 1.0, residual = 1.0;
    for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
      const SimulationOutcome end =
          run(model, by(integrator, tolerance, steps_of(1e-2, 2.0, 1e-2)));
      const double now = distance(end.final_state, fixed.final_state);
      EXPECT_LT(now, 0.1 * error) << tolerance;
      EXPECT_LT(end.energy_residual_max, 0.1 * residual) << tolerance;
      EXPECT_LT(now, 100 * tolerance);
      error = now;
      residual = end.energy_residual_max;
    }
    EXPECT_GT(residual, 0.0);
  }
}

TEST(LocatedRun, The_pendulum_returns_after_its_published_period) {
  const Model model = compile(pendulum());
  for (const Integrator integrator : kAdaptive) {
    const SimulationOutcome end = run(model, by(integrator, 1e-11, steps_of(0.1, kPendulumPeriod)));
    EXPECT_NEAR(end.final_state.q[PositionIndex(0)], 0.0, 1e-8);
    EXPECT_NEAR(end.final_state.v[VelocityIndex(0)], 0.0, 2e-8);
  }
}

TEST(LocatedRun, The_spatial_slider_crank_follows_the_published_series_with_its_energy) {
  const Csv published = read_csv(source_file("tests/reference/spatial_slider_crank_gonzalez.csv"));
  const std::vector<double>& x = published.column("x_slider_m");
  const Model model = compile(spatial_slider_crank());
  for (const Integrator integrator : kAdaptive) {
    const Samples s = run(model, by(integrator, 1e-9, steps_of(1e-2, 5.0, 1e-2)),
                          {"joint.P.q", "energy.kinetic", "energy.potential"});
    ASSERT_EQ(s.values.rows(), static_cast<Eigen::Index>(x.size()));
    for (Eigen::Index k = 0; k < s.values.rows(); ++k) {
      EXPECT_NEAR(s.values(k, 0), x[static_cast<std::size_t>(k)], 1e-4) << k;
      EXPECT_NEAR(s.values(k, 1) + s.values(k, 2), kSpatialSliderCrankEnergy, 1e-6) << k;
    }
  }
}

TEST(LocatedRun, What_is_seen_inside_its_steps_is_what_constant_steps_see) {
  const Model model = compile(rsrrp());
  const std::vector<std::string> signals = {"time", "joint.A.q", "joint.A.v", "joint.A.a",
                                            "closure.S.force"};
  const Samples fixed = run(model, steps_of(1e-4, 1.0, 1e-3), signals);
  for (const Integrator integrator : kAdaptive) {
    const Samples s = run(model, by(integrator, 1e-9, steps_of(1e-3, 1.0, 1e-3)), signals);
    ASSERT_EQ(s.values.rows(), fixed.values.rows());
    EXPECT_LT(s.outcome.steps, 500);  // so most instants are inside
    EXPECT_LT((s.values.leftCols(4) - fixed.values.leftCols(4)).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((s.values.rightCols(3) - fixed.values.rightCols(3)).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(LocatedRun, Its_steps_do_not_depend_on_what_is_observed) {
  const Model model = compile(rsrrp());
  for (const Integrator integrator : kAdaptive) {
    const SimulationOutcome blind = run(model, by(integrator, 1e-7, steps_of(0.5, 1.0)));
    const Samples seen =
        run(model, by(integrator, 1e-7, steps_of(1e-3, 1.0, 1e-3)), {"closure.S.force"});
    EXPECT_EQ(seen.outcome.steps, blind.steps);
    EXPECT_EQ(seen.outcome.final_state.q, blind.final_state.q);
    EXPECT_NEAR(static_cast<double>(seen.outcome.evaluations - blind.evaluations), 1000.0, 2.0);
  }
}

TEST(LocatedRun, Projection_keeps_closures_shut_inside_its_steps_too) {
  const Model model = compile(projected_rsrrp());
  for (const Integrator integrator : kAdaptive) {
    const Samples s =
        run(model, by(integrator, 1e-6, steps_of(1e-3, 1.0, 1e-3)), {"closure.S.gap"});
    EXPECT_LT(s.values.cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(s.outcome.drift_max, 1e-12);
  }
}

TEST(LocatedRun, Quaternions_stay_of_unit_length_and_end_where_constant_steps_do) {
  RandomTree options;
  options.links = 3;
  options.types = {JointType::spherical, JointType::free};
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Model model = compile(with_quaternions(random_tree(seed, options)));
    const SimulationOutcome fixed = run(model, steps_of(1e-4, 0.5));
    for (const Integrator integrator : kAdaptive) {
      const SimulationOutcome end = run(model, by(integrator, 1e-9, steps_of(1e-2, 0.5)));
      ASSERT_EQ(end.cause, Cause::ok) << end.message;
      EXPECT_LT(distance(end.final_state, fixed.final_state), 1e-6) << seed;
      ASSERT_FALSE(model.mechanism.ball_q.empty());
      for (const PositionIndex i : model.mechanism.ball_q) {
        const double* q = &end.final_state.q[i];
        EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-14);
      }
    }
  }
}

TEST(LocatedRun, A_stiff_replacement_joint_takes_the_implicit_integrator_fewer_evaluations) {
  Linkage linkage = replaced_rsrrp(1e8);
  linkage.closures[0].sde.damping = {1e6, 1e6, 1e6, 0, 0, 0};
  const Model model = compile(linkage);
  const SimulationOutcome stiff = run(model, by(Integrator::stiff, 1e-6, steps_of(1e-2, 0.02)));
  const SimulationOutcome other = run(model, by(Integrator::adaptive, 1e-6, steps_of(1e-2, 0.02)));
  ASSERT_EQ(stiff.cause, Cause::ok) << stiff.message;
  ASSERT_EQ(other.cause, Cause::ok) << other.message;
  EXPECT_LT(distance(stiff.final_state, other.final_state), 1e-5);
  EXPECT_GT(other.evaluations, 20 * stiff.evaluations);
}

// A four-bar whose pin is far overdamped, b = 6 sqrt(c): rates from b / c = 1.9e-4 s down to 1e-6
// s. Each decade of stiffness costs a fifth more steps, not the twofold that order reduction would.
TEST(LocatedRun, Four_decades_of_stiffness_cost_an_implicit_run_less_than_three_times_the_steps) {
  const auto pinned = [](double stiffness, double tolerance) {
    Linkage linkage = four_bar();
    const double b = 6.0 * std::sqrt(stiffness);
    Closure& pin = linkage.closures[0];
    pin.model = ClosureModel::sde;
    pin.sde.stiffness = {stiffness, stiffness, stiffness, 0, 1e-2 * stiffness, 1e-2 * stiffness};
    pin.sde.damping = {b, b, b, 0, 1e-2 * b, 1e-2 * b};
    return run(compile(linkage), by(Integrator::stiff, tolerance, steps_of(1e-2, 1.0)));
  };
  const SimulationOutcome soft = pinned(1e5, 1e-8);
  for (const double stiffness : {1e5, 1e7, 1e9}) {
    const SimulationOutcome end = pinned(stiffness, 1e-8), exact = pinned(stiffness, 1e-10);
    ASSERT_EQ(end.cause, Cause::ok) << end.message;
    ASSERT_EQ(exact.cause, Cause::ok) << exact.message;
    EXPECT_LT(end.steps, 3 * soft.steps) << stiffness;
    EXPECT_LT(end.evaluations, 4 * soft.evaluations) << stiffness;
    EXPECT_LT(distance(end.final_state, exact.final_state), 1e-6) << stiffness;
  }
  EXPECT_LT(soft.steps, 1200);
}

TEST(LocatedRun, What_ends_it_is_told_with_the_state_reached) {
  const Model model = compile(rsrrp());
  for (const Integrator integrator : kAdaptive) {
    SimulationOptions options = by(integrator, 1e-8, steps_of(1e-3, 2.0));
    options.step_limit = 40;
    const SimulationOutcome spent = run(model, options);
    EXPECT_EQ(spent.cause, Cause::step_budget);
    EXPECT_EQ(spent.steps, 40);
    EXPECT_NE(spent.message.find("step_limit"), std::string::npos);
    EXPECT_GT(spent.end_time, 0.0);
    EXPECT_LT(spent.end_time, 2.0);
    options.step_limit = 100'000;
    options.end_time = spent.end_time;
    const SimulationOutcome again = run(model, options);
    EXPECT_LT(distance(again.final_state, spent.final_state), 1e-7);
    options.end_time = 2.0;
    options.drift_limit = 1e-13;
    EXPECT_EQ(run(model, options).cause, Cause::constraint_drift);
    Model lost = compile(pendulum());
    lost.start.v[VelocityIndex(0)] = std::nan("");
    EXPECT_EQ(run(lost, by(integrator, 1e-8, steps_of(1e-3, 1.0))).cause, Cause::diverged);
  }
}

TEST(LocatedRun, It_can_be_cancelled_and_runs_out_of_time) {
  const Model model = compile(rsrrp());
  const std::atomic<bool> cancelled = true;
  for (const Integrator integrator : kAdaptive) {
    Observers none;
    const SimulationOptions options = by(integrator, 1e-9, steps_of(1e-3, 100.0));
    RunLimits limits;
    limits.cancelled = &cancelled;
    EXPECT_EQ(simulate(model.mechanism, model.parameters, model.start, options, none, limits).cause,
              Cause::cancelled);
    RunLimits hurried;
    hurried.timeout_s = 1e-9;
    EXPECT_EQ(
        simulate(model.mechanism, model.parameters, model.start, options, none, hurried).cause,
        Cause::timeout);
  }
}

TEST(LocatedRun, Cases_of_a_batch_are_what_they_are_alone) {
  const Model soft = compile(replaced_rsrrp(1e4)), hard = compile(replaced_rsrrp(1e6));
  const SimulationOptions options = by(Integrator::adaptive, 1e-7, steps_of(1e-3, 0.5));
  Observers none[2];
  std::vector<BatchCase> cases{{&soft.parameters, &soft.start, &none[0], {}},
                               {&hard.parameters, &hard.start, &none[1], {}}};
  simulate_batch(soft.mechanism, options, cases);
  EXPECT_EQ(cases[0].outcome.final_state.q, run(soft, options).final_state.q);
  EXPECT_EQ(cases[1].outcome.final_state.q, run(hard, options).final_state.q);
  EXPECT_NE(cases[0].outcome.steps, cases[1].outcome.steps);
}

}  // namespace linkstudy::testing::located_run_test
