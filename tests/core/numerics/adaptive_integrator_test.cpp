// Adaptive integrators against closed solutions and published values: orders, tolerances, dense
// output, stiff problems, restarts, failures.
#include "core/numerics/adaptive_integrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace linkstudy::testing::adaptive_integrator_test {
namespace {

constexpr AdaptiveMethod kMethods[] = {AdaptiveMethod::dormand_prince, AdaptiveMethod::radau};

std::unique_ptr<AdaptiveIntegrator> make(AdaptiveMethod method, Slopes f, int size,
                                         double tolerance, double max_step = 0.0) {
  AdaptiveProblem problem;
  problem.slopes = std::move(f);
  problem.relative = tolerance;
  problem.absolute.assign(static_cast<std::size_t>(size), tolerance);
  problem.max_step = max_step;
  return make_adaptive_integrator(method, std::move(problem));
}

void finish(AdaptiveIntegrator& run, double end) {
  while (run.t() < end) ASSERT_EQ(run.step(end), StepResult::accepted) << run.t();
}

// y' = y cos t: y = exp(sin t).
void swell(double t, const double* y, double* dy) {
  dy[0] = y[0] * std::cos(t);
}

// Pendulum of length 1 m, from horizontal at rest; angle from horizontal, downwards.
void pendulum(double, const double* y, double* dy) {
  dy[0] = y[1];
  dy[1] = 9.81 * std::cos(y[0]);
}

// y' = 2 cos t - y, y = cos t + sin t: linear, with one Jacobian, so that Newton leaves nothing.
void follow(double t, const double* y, double* dy) {
  dy[0] = 2.0 * std::cos(t) - y[0];
}
double followed(double t) {
  return std::cos(t) + std::sin(t);
}

// Error of steps of one length: the tolerance accepts everything, the length is the largest.
double fixed_step_error(AdaptiveMethod method, double h) {
  const auto run = make(method, follow, 1, 1e3, h);
  const double y0 = 1.0;
  run->start(0.0, &y0, h);
  finish(*run, 2.0);
  EXPECT_EQ(run->steps(), std::lround(2.0 / h));
  return std::fabs(run->y()[0] - followed(2.0));
}

// Largest error inside one step of length h.
double dense_error(AdaptiveMethod method, double h) {
  const auto run = make(method, follow, 1, 1e3, h);
  const double begin = 0.4, y0 = followed(begin);
  run->start(begin, &y0, h);
  EXPECT_EQ(run->step(10.0), StepResult::accepted);
  EXPECT_NEAR(run->t(), begin + h, 1e-15);
  double worst = 0.0;
  for (int k = 0; k <= 32; ++k) {
    const double t = begin + h * k / 32.0;
    double y = 0.0;
    run->value_at(t, &y);
    worst = std::max(worst, std::fabs(y - followed(t)));
  }
  return worst;
}

double pendulum_error(AdaptiveMethod method, double tolerance) {
  const auto run = make(method, pendulum, 2, tolerance);
  const double y0[] = {0.0, 0.0};
  run->start(0.0, y0);
  finish(*run, 1.5);
  // Energy: v^2 = 2 g sin(angle).
  return std::fabs(run->y()[1] * run->y()[1] - 2 * 9.81 * std::sin(run->y()[0]));
}

// Van der Pol, y'' = mu (1 - y^2) y' - y.
Slopes van_der_pol(double mu) {
  return [mu](double, const double* y, double* dy) {
    dy[0] = y[1];
    dy[1] = mu * (1.0 - y[0] * y[0]) * y[1] - y[0];
  };
}

// A slow course that everything is drawn to at the rate 1e5: y = sin t + exp(-1e5 t).
void drawn(double t, const double* y, double* dy) {
  dy[0] = -1e5 * (y[0] - std::sin(t)) + std::cos(t);
}

}  // namespace

TEST(AdaptiveIntegrator, Steps_of_one_length_are_of_the_order_of_the_method) {
  for (const double h : {0.2, 0.1}) {
    const auto order = [h](AdaptiveMethod m) {
      return std::log2(fixed_step_error(m, h) / fixed_step_error(m, h / 2));
    };
    EXPECT_NEAR(order(AdaptiveMethod::dormand_prince), 5.0, 0.4) << h;
    EXPECT_NEAR(order(AdaptiveMethod::radau), 5.0, 0.4) << h;
  }
}

TEST(AdaptiveIntegrator, Dense_output_is_of_order_four_and_three) {
  // Within a single step an interpolant of order p errs by h^(p + 1).
  for (const double h : {0.2, 0.1}) {
    const auto power = [h](AdaptiveMethod m) {
      return std::log2(dense_error(m, h) / dense_error(m, h / 2));
    };
    EXPECT_NEAR(power(AdaptiveMethod::dormand_prince), 5.0, 0.5) << h;
    EXPECT_NEAR(power(AdaptiveMethod::radau), 4.0, 0.5) << h;
  }
}

TEST(AdaptiveIntegrator, The_error_falls_with_the_tolerance) {
  for (const AdaptiveMethod method : kMethods) {
    double before = pendulum_error(method, 1e-4);
    for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
      const double error = pendulum_error(method, tolerance);
      EXPECT_LT(error, 0.1 * before) << tolerance;
      EXPECT_GT(error, 1e-4 * before) << tolerance;
      EXPECT_LT(error, 300 * tolerance);
      before = error;
    }
  }
}

TEST(AdaptiveIntegrator, The_pendulum_returns_after_its_published_period) {
  const double period = 2.367841948;  // IFToMM benchmark A01
  for (const AdaptiveMethod method : kMethods) {
    const auto run = make(method, pendulum, 2, 1e-11);
    const double y0[] = {0.0, 0.0};
    run->start(0.0, y0);
    finish(*run, period);
    EXPECT_NEAR(run->y()[0], 0.0, 1e-8);
    EXPECT_NEAR(run->y()[1], 0.0, 2e-8);
    EXPECT_LT(run->evaluations(), 20000);
  }
}

TEST(AdaptiveIntegrator, A_tolerance_of_an_unknown_is_its_own) {
  // Two copies of one equation, one in micrometres: with tolerances to match, the same steps.
  const auto both = [](double t, const double* y, double* dy) {
    dy[0] = y[0] * std::cos(3 * t);
    dy[1] = y[1] * std::cos(3 * t);
  };
  for (const AdaptiveMethod method : kMethods) {
    long steps[2];
    for (const int k : {0, 1}) {
      AdaptiveProblem problem;
      problem.slopes = both;
      problem.relative = 1e-12;
      problem.absolute = {1e-7, k == 0 ? 1e-7 : 1e-1};
      const auto run = make_adaptive_integrator(method, problem);
      const double y0[] = {1.0, k == 0 ? 1.0 : 1e6};
      run->start(0.0, y0, 1e-3);
      finish(*run, 3.0);
      steps[k] = run->steps();
      EXPECT_NEAR(run->y()[0], std::exp(std::sin(9.0) / 3.0), 3e-6);
    }
    EXPECT_EQ(steps[0], steps[1]);
  }
}

TEST(AdaptiveIntegrator, Van_der_Pol_reaches_its_published_state_by_few_implicit_evaluations) {
  // Hairer and Wanner, Solving Ordinary Differential Equations II, IV.10: eps = 1e-6 in the scaled
  // time x = t / mu, y(2) = (1.70616773217048, -0.892809701024795).
  const double eps = 1e-6;
  const auto f = [eps](double, const double* y, double* dy) {
    dy[0] = y[1];
    dy[1] = ((1.0 - y[0] * y[0]) * y[1] - y[0]) / eps;
  };
  const auto run = make(AdaptiveMethod::radau, f, 2, 1e-8);
  const double y0[] = {2.0, -0.66};
  run->start(0.0, y0);
  finish(*run, 2.0);
  EXPECT_NEAR(run->y()[0], 1.706167732170483, 1e-6);
  EXPECT_NEAR(run->y()[1], -0.892809701024795, 1e-6);
  EXPECT_LT(run->evaluations(), 60000);
}

TEST(AdaptiveIntegrator, A_stiff_problem_takes_the_explicit_method_fifty_times_the_evaluations) {
  const double y0[] = {2.0, 0.0};
  const auto implicit = make(AdaptiveMethod::radau, van_der_pol(1000.0), 2, 1e-6);
  implicit->start(0.0, y0);
  finish(*implicit, 800.0);
  const auto explicit_run = make(AdaptiveMethod::dormand_prince, van_der_pol(1000.0), 2, 1e-6);
  explicit_run->start(0.0, y0);
  finish(*explicit_run, 800.0);
  EXPECT_NEAR(implicit->y()[0], explicit_run->y()[0], 1e-4);
  EXPECT_GT(explicit_run->evaluations(), 50 * implicit->evaluations());
}

TEST(AdaptiveIntegrator, A_course_that_draws_is_followed_by_large_implicit_steps) {
  const double y0 = 1.0;
  const auto run = make(AdaptiveMethod::radau, drawn, 1, 1e-8);
  run->start(0.0, &y0);
  finish(*run, 10.0);
  EXPECT_NEAR(run->y()[0], std::sin(10.0), 1e-7);
  EXPECT_GT(run->t() - run->t_old(), 500 / 1e5);
  const auto slow = make(AdaptiveMethod::dormand_prince, drawn, 1, 1e-8);
  slow->start(0.0, &y0);
  finish(*slow, 10.0);
  EXPECT_GT(slow->evaluations(), 50 * run->evaluations());
}

TEST(AdaptiveIntegrator, Passive_unknowns_save_the_evaluations_of_their_columns) {
  const auto f = [](double t, const double* y, double* dy) {
    pendulum(t, y, dy);
    dy[2] = y[1] * y[1];
    dy[3] = y[0];
  };
  const double y0[] = {0.0, 0.0, 0.0, 0.0};
  double end[2];
  long evaluations[2], steps[2];
  for (const int passive : {0, 2}) {
    AdaptiveProblem problem{f, 1e-8, std::vector<double>(4, 1e-8), passive};
    const auto run = make_adaptive_integrator(AdaptiveMethod::radau, problem);
    run->start(0.0, y0, 1e-3);
    finish(*run, 1.0);
    end[passive / 2] = run->y()[2];
    evaluations[passive / 2] = run->evaluations();
    steps[passive / 2] = run->steps();
  }
  EXPECT_NEAR(end[0], end[1], 1e-12);
  EXPECT_EQ(steps[0], steps[1]);
  // Two unknowns, two evaluations of each in every Jacobian.
  EXPECT_GT(evaluations[0], evaluations[1]);
  EXPECT_EQ((evaluations[0] - evaluations[1]) % 4, 0);
}

// Van der Pol: y'' = mu (1 - y^2) y' - y.
TEST(AdaptiveIntegrator, A_derivative_that_is_known_saves_all_evaluations_of_differences) {
  constexpr double mu = 100.0;
  const auto f = [](double, const double* y, double* dy) {
    dy[0] = y[1];
    dy[1] = mu * (1.0 - y[0] * y[0]) * y[1] - y[0];
  };
  int asked = 0;
  bool is_known = true;
  const auto derivative = [&](double, const double* y, double* columns) {
    ++asked;
    columns[0] = 0.0;
    columns[1] = -2.0 * mu * y[0] * y[1] - 1.0;
    columns[2] = 1.0;
    columns[3] = mu * (1.0 - y[0] * y[0]);
    return is_known;
  };
  const double y0[] = {2.0, 0.0};
  struct End {
    double y;
    long evaluations, steps;
  };
  const auto run = [&](const SlopeDerivative& known) {
    AdaptiveProblem problem{f, 1e-8, std::vector<double>(2, 1e-8)};
    problem.derivative = known;
    const auto radau = make_adaptive_integrator(AdaptiveMethod::radau, problem);
    radau->start(0.0, y0, 1e-3);
    finish(*radau, 150.0);
    return End{radau->y()[0], radau->evaluations(), radau->steps()};
  };
  const End exact = run(derivative);
  const int jacobians = asked;
  const End differences = run(nullptr);
  is_known = false;
  const End unknown = run(derivative);
  EXPECT_NEAR(exact.y, differences.y, 1e-6);
  EXPECT_NEAR(static_cast<double>(exact.steps), static_cast<double>(differences.steps),
              0.02 * static_cast<double>(differences.steps));
  EXPECT_NEAR(static_cast<double>(differences.evaluations - exact.evaluations), 4.0 * jacobians,
              0.4 * jacobians + 0.02 * static_cast<double>(differences.evaluations));
  EXPECT_EQ(unknown.y, differences.y);
  EXPECT_EQ(unknown.evaluations, differences.evaluations);
}

TEST(AdaptiveIntegrator, A_step_ends_where_it_must_and_the_next_keeps_its_length) {
  for (const AdaptiveMethod method : kMethods) {
    const auto run = make(method, swell, 1, 1e-6);
    const double y0 = 1.0;
    run->start(0.0, &y0);
    ASSERT_EQ(run->step(10.0), StepResult::accepted);
    ASSERT_EQ(run->step(10.0), StepResult::accepted);
    const double length = run->next_step(), stop = run->t() + 0.1 * length;
    ASSERT_EQ(run->step(stop), StepResult::accepted);
    EXPECT_EQ(run->t(), stop);
    EXPECT_GE(run->next_step(), length);
    EXPECT_NEAR(run->y()[0], std::exp(std::sin(stop)), 1e-5);
  }
}

TEST(AdaptiveIntegrator, A_restart_in_the_middle_of_a_step_goes_on_as_if_nothing_had_been) {
  for (const AdaptiveMethod method : kMethods) {
    const auto run = make(method, pendulum, 2, 1e-10);
    double y[] = {0.0, 0.0};
    run->start(0.0, y);
    while (run->t() < 0.7) ASSERT_EQ(run->step(2.0), StepResult::accepted);
    run->value_at(0.7, y);
    run->start(0.7, y, run->next_step());
    EXPECT_EQ(run->t(), 0.7);
    finish(*run, 1.5);
    const auto whole = make(method, pendulum, 2, 1e-12);
    const double y0[] = {0.0, 0.0};
    whole->start(0.0, y0);
    finish(*whole, 1.5);
    EXPECT_NEAR(run->y()[0], whole->y()[0], 1e-7);
    EXPECT_NEAR(run->y()[1], whole->y()[1], 1e-7);
  }
}

TEST(AdaptiveIntegrator, Another_equation_after_a_step_is_taken_up_at_once) {
  for (const AdaptiveMethod method : kMethods) {
    double force = 1.0;
    const auto run = make(
        method, [&](double, const double*, double* dy) { dy[0] = force; }, 1, 1e-8);
    const double y0 = 0.0;
    run->start(0.0, &y0, 0.1);
    finish(*run, 1.0);
    EXPECT_NEAR(run->y()[0], 1.0, 1e-13);
    force = -2.0;
    run->replace(run->y());
    finish(*run, 2.0);
    EXPECT_NEAR(run->y()[0], -1.0, 1e-12);
  }
}

TEST(AdaptiveIntegrator, A_solution_that_ends_in_a_pole_is_a_typed_failure) {
  // y' = y^2, y = 1 / (1 - t).
  for (const AdaptiveMethod method : kMethods) {
    const auto run = make(
        method, [](double, const double* y, double* dy) { dy[0] = y[0] * y[0]; }, 1, 1e-8);
    const double y0 = 1.0;
    run->start(0.0, &y0);
    StepResult result = StepResult::accepted;
    for (int k = 0; k < 100000 && result == StepResult::accepted; ++k) result = run->step(2.0);
    EXPECT_NE(result, StepResult::accepted);
    EXPECT_NEAR(run->t(), 1.0, 1e-5);
  }
}

TEST(AdaptiveIntegrator, Slopes_that_are_no_numbers_are_a_typed_failure) {
  for (const AdaptiveMethod method : kMethods) {
    const auto run = make(
        method, [](double t, const double*, double* dy) { dy[0] = t > 0.5 ? std::nan("") : 1.0; },
        1, 1e-8);
    const double y0 = 0.0;
    run->start(0.0, &y0, 0.1);
    StepResult result = StepResult::accepted;
    while (result == StepResult::accepted) result = run->step(2.0);
    EXPECT_EQ(result, StepResult::not_finite);
    EXPECT_LE(run->t(), 0.5);
    EXPECT_NEAR(run->t(), 0.5, 1e-7);  // differences reach ahead by 1e-8 of the time
    EXPECT_GT(run->rejected(), 0);
    const auto lost = make(method, swell, 1, 1e-8);
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    lost->start(0.0, &nothing);
    EXPECT_EQ(lost->step(1.0), StepResult::not_finite);
  }
}

// A pendulum with the integral of its speed beside it, which is the way of its angle.
TEST(AdaptiveIntegrator, An_integral_without_a_tolerance_changes_no_bit_of_the_others) {
  for (const AdaptiveMethod method : kMethods) {
    const auto alone = make(method, pendulum, 2, 1e-8);
    AdaptiveProblem problem;
    problem.slopes = [](double t, const double* y, double* dy) {
      pendulum(t, y, dy);
      dy[2] = y[1];
    };
    problem.relative = 1e-8;
    problem.absolute = {1e-8, 1e-8, std::numeric_limits<double>::infinity()};
    problem.passive = 1;
    const auto beside = make_adaptive_integrator(method, problem);
    const double start[] = {0.0, 0.0, 3.0};
    alone->start(0.0, start);
    beside->start(0.0, start);
    while (alone->t() < 2.0) {
      ASSERT_EQ(alone->step(2.0), StepResult::accepted);
      ASSERT_EQ(beside->step(2.0), StepResult::accepted);
      ASSERT_EQ(beside->t(), alone->t());
      EXPECT_EQ(beside->y()[0], alone->y()[0]);
      EXPECT_EQ(beside->y()[1], alone->y()[1]);
      // Within what the equations of a step are solved to.
      EXPECT_NEAR(beside->y()[2] - 3.0, beside->y()[0], 1e-6);
      double inside[3];
      beside->value_at(0.7 * beside->t_old() + 0.3 * beside->t(), inside);
      EXPECT_NEAR(inside[2] - 3.0, inside[0], 1e-5) << "dense output of order 3";
    }
  }
}

}  // namespace linkstudy::testing::adaptive_integrator_test
