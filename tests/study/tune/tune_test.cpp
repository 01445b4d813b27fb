#include <set>

#include "synthetic_error.h"

namespace linkstudy::tuning::tune_test {
namespace {

using testing::decades;
using testing::SyntheticError;
using testing::Term;

constexpr double kResolution = 1e-3;  // the default, decades

TuningResult run(SyntheticError& model, const TuningOptions& options = {}) {
  return tune(model.problem(), options, model.evaluator());
}

TEST(Tune, Finds_the_lowest_stiffness_of_a_closed_form_within_the_resolution) {
  SyntheticError model;
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_GE(result.point.at(0), model.ends().low);
  EXPECT_LE(decades(result.point.at(0), model.ends().low), kResolution);
  EXPECT_NEAR(decades(result.window->high, model.ends().high), -0.5 * kResolution,
              0.51 * kResolution);
  EXPECT_LE(result.window->high, model.ends().high);
  EXPECT_EQ(result.window->high_limited_by, HighLimit::accuracy);
  EXPECT_LT(result.observations.size(), 60U);
}

TEST(Tune, Needs_every_component_to_match) {
  SyntheticError model;
  model.terms = {{200.0, 1.0, 0.02}, {5000.0, 0.1, 0.03}, {10.0, 9.0, 0.01}};
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_NEAR(decades(result.point.at(0), model.ends().low), 0.5 * kResolution, 0.5 * kResolution);
  EXPECT_EQ(result.binding, 1U);
  EXPECT_NEAR(decades(result.window->high, model.ends().high), -0.5 * kResolution,
              0.51 * kResolution);
}

TEST(Tune, Is_right_for_two_hundred_random_models) {
  std::mt19937_64 generator(20240611);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    SyntheticError model;
    // Lower end in [1.2e3, 5e5], upper end 0.7 to 2 decades above: both inside the range.
    const double low = 1.2e3 * std::pow(10.0, 2.6 * unit(generator));
    const double high = low * std::pow(10.0, 0.7 + 1.3 * unit(generator));
    model.terms[0].soft = 0.02 * low;
    model.terms[0].coarse = 0.02 / (high * high * std::pow(model.step, 4.0));
    TuningOptions options;
    options.scan = 8 + static_cast<std::size_t>(16.0 * unit(generator));
    options.batch = 1 + static_cast<std::size_t>(15.0 * unit(generator));
    const TuningResult result = run(model, options);
    ASSERT_EQ(result.status, TuningStatus::certified) << i << ": " << result.reason;
    ASSERT_GE(decades(result.point.at(0), model.ends().low), 0.0) << i;
    ASSERT_LE(decades(result.point.at(0), model.ends().low), kResolution) << i;
    ASSERT_NEAR(decades(result.window->high, model.ends().high), -0.5 * kResolution,
                0.51 * kResolution)
        << i;
  }
}

TEST(Tune, Names_stability_where_a_cliff_ends_the_window) {
  SyntheticError model;
  model.terms = {{200.0, 0.0}};
  model.limit_scale = 1e-4 * std::sqrt(3e5);  // h = 1e-4 is stable up to c = 3e5
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_EQ(result.window->high_limited_by, HighLimit::stability);
  EXPECT_NEAR(decades(result.window->high, 3e5), -0.5 * kResolution, 0.51 * kResolution);
  EXPECT_EQ(result.points.back().side, Side::diverged);
  EXPECT_EQ(result.points.front().side, Side::too_soft);
}

TEST(Tune, Names_the_range_where_nothing_else_ends_the_window) {
  SyntheticError model;
  model.terms = {{200.0, 0.0}};
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_EQ(result.window->high_limited_by, HighLimit::range);
  EXPECT_EQ(result.window->high, 1e8);
}

TEST(Tune, Finds_a_window_that_lies_between_two_scan_points) {
  for (const double width : {0.02, 0.05, 0.1, 0.2}) {
    for (double center = 4.0; center < 6.0; center += 0.13) {
      SyntheticError model;
      const double low = std::pow(10.0, center);
      const double high = low * std::pow(10.0, width);
      // A and B from the two ends: D (high^3 - low^3) = tol (high - low), A = tol low - D low^3.
      const double d = 0.02 * (high - low) / (std::pow(high, 3.0) - std::pow(low, 3.0));
      model.terms = {{0.02 * low - d * std::pow(low, 3.0), d / std::pow(model.step, 4.0)}};
      const TuningResult result = run(model);
      ASSERT_FALSE(result.point.empty()) << center << ' ' << width;
      ASSERT_GE(decades(result.point[0], low), 0.0) << center << ' ' << width;
      ASSERT_LE(decades(result.point[0], low), kResolution) << center << ' ' << width;
      ASSERT_NE(result.status, TuningStatus::refuted) << result.reason;
    }
  }
}

TEST(Tune, Says_which_step_opens_an_empty_window_and_that_step_does) {
  SyntheticError model;
  model.terms = {{2e4, 50.0}};
  // The smallest error over c is 1.5 A / c at c^3 = A / (2 B h^4); equal to the tolerance at:
  const double c = 1.5 * 2e4 / 0.02;
  const double opening = std::pow(2e4 / (2.0 * 50.0 * c * c * c), 0.25);
  model.step = 3.0 * opening;
  const TuningResult closed = run(model);
  EXPECT_EQ(closed.status, TuningStatus::infeasible) << closed.reason;
  EXPECT_FALSE(closed.window.has_value());
  ASSERT_TRUE(closed.suggestion.has_value());
  EXPECT_NEAR(closed.suggestion->opens_at, opening, 0.05 * opening);
  EXPECT_LT(closed.suggestion->step, 0.75 * opening);
  EXPECT_GT(closed.suggestion->step, 0.6 * opening);
  EXPECT_EQ(closed.points.front().side, Side::too_soft);
  EXPECT_EQ(closed.points.back().side, Side::step_too_coarse);
  model.step = closed.suggestion->step;
  const TuningResult opened = run(model);
  EXPECT_EQ(opened.status, TuningStatus::certified) << opened.reason;
}

TEST(Tune, Asks_for_a_higher_range_where_every_point_is_too_soft) {
  SyntheticError model;
  model.terms = {{1e8, 0.0}};
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::infeasible);
  EXPECT_NE(result.reason.find("raise its end above 5e+09 N/m"), std::string::npos)
      << result.reason;
  for (const ScanPoint& point : result.points) EXPECT_EQ(point.side, Side::too_soft) << point.value;
}

// The smallest error is 1.5 A / c = 30 times the tolerance, from where it rises: a higher end alone
// would only add runs that fail by their step.
TEST(Tune, Never_advises_a_higher_range_alone_where_the_step_ends_it) {
  for (const bool by_stability : {false, true}) {
    SyntheticError model;
    const double best = 1e6;
    model.terms = {{2e4, by_stability ? 0.0 : 2e4 / (2.0 * std::pow(best, 3.0) * 1e-16)}};
    model.terms[0].tolerance = 1e-6;
    if (by_stability) model.limit_scale = 1e-4 * std::sqrt(2.0 * best);
    const TuningResult result = run(model);
    EXPECT_EQ(result.status, TuningStatus::infeasible);
    EXPECT_EQ(result.reason.find("raise its end"), std::string::npos) << result.reason;
    EXPECT_NE(result.reason.find(by_stability ? "(diverged)" : "(step too coarse)"),
              std::string::npos)
        << result.reason;
    // What is advised opens a window: that step, and a range beyond what softness asks for.
    ASSERT_GT(result.suggestion->step, 0.0) << result.reason;
    EXPECT_GT(result.suggestion->value, 2e10);
    model.step = result.suggestion->step;
    const TuningResult opened =
        tune(model.problem(1e3, 10.0 * result.suggestion->value), {}, model.evaluator());
    EXPECT_EQ(opened.status, TuningStatus::certified) << opened.reason;
  }
}

TEST(Tune, Names_the_component_that_misses_by_least_and_the_first_run_that_ended) {
  SyntheticError model;
  model.terms = {{2e2, 1.0, 0.02}, {2e8, 0.0, 0.03}};  // the second is too soft up to 6.7e9
  model.cause = [](double c, double) { return c < 5e3 ? Cause::statics_failed : Cause::ok; };
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::infeasible);
  EXPECT_EQ(result.binding, 1U);
  EXPECT_NE(result.reason.find("force.1"), std::string::npos) << result.reason;
  EXPECT_GT(result.answer_value, 1e7);
  ASSERT_TRUE(result.first_failure.has_value());
  EXPECT_EQ(result.first_failure->answer.id, 0U);
  EXPECT_EQ(result.first_failure->answer.status, Cause::statics_failed);
}

TEST(Tune, Reports_a_range_of_diverging_runs_with_the_step_that_is_stable) {
  SyntheticError model;
  model.limit_scale = 1e-4 * std::sqrt(1e2);  // stable at c = 1e3 for h < 3.16e-5
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::infeasible);
  EXPECT_NEAR(result.suggestion->opens_at, 3.16e-5, 1e-7);
  EXPECT_NEAR(result.suggestion->step, 2.2e-5, 1e-7);
  EXPECT_EQ(result.points.front().side, Side::diverged);
}

TEST(Tune, Is_inconclusive_where_the_low_end_of_the_range_already_matches) {
  SyntheticError model;
  model.terms = {{1.0, 0.0}};
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::inconclusive);
  EXPECT_EQ(result.point.at(0), 1e3);
  EXPECT_TRUE(result.window->low_open);
  EXPECT_EQ(result.certificate->claims[0].verdict, Verdict::certified);
  EXPECT_EQ(result.certificate->claims[1].verdict, Verdict::inconclusive);
  EXPECT_EQ(result.certificate->claims[2].verdict, Verdict::certified);
  EXPECT_NE(result.certificate->claims[1].reason.find("lower its low end"), std::string::npos);
}

TEST(Tune, Stays_within_the_noise_of_a_noisy_error) {
  for (int i = 0; i < 30; ++i) {
    SyntheticError model;
    model.terms[0].soft = 200.0 * (1.0 + 0.1 * i);
    model.disturbance = testing::make_noise(3e-3);
    const TuningResult result = run(model);
    ASSERT_FALSE(result.point.empty());
    // A slope of -1 turns 3e-3 decades of error into 3e-3 decades of stiffness.
    ASSERT_NEAR(decades(result.point[0], model.ends().low), 0.0, 3e-3 + kResolution) << i;
    ASSERT_NE(result.status, TuningStatus::infeasible);
    ASSERT_NE(result.certificate->claims[3].verdict, Verdict::refuted)
        << i << result.certificate->claims[3].reason;
  }
}

TEST(Tune, Does_not_take_a_noisy_boundary_for_the_end_of_the_window) {
  for (std::size_t batch : {1U, 2U, 4U, 8U}) {
    for (int i = 0; i < 25; ++i) {
      SyntheticError model;
      model.terms[0].soft = 200.0 * (1.0 + 0.3 * i);
      model.disturbance = testing::make_noise(1e-2);
      TuningOptions options;
      options.batch = batch;
      const TuningResult result = run(model, options);
      ASSERT_GT(result.window->margin, 1.0) << batch << ' ' << i;
      ASSERT_NE(result.status, TuningStatus::refuted) << batch << ' ' << i << result.reason;
    }
  }
}

TEST(Tune, Does_not_certify_a_slope_that_the_noise_hides) {
  SyntheticError model;
  model.disturbance = testing::make_noise(0.15);
  const TuningResult result = run(model);
  EXPECT_NE(result.status, TuningStatus::certified);
  EXPECT_NE(result.certificate->claims[3].verdict, Verdict::certified);
}

TEST(Tune, Goes_below_a_bump_when_the_scan_shows_a_match_there) {
  SyntheticError model;  // matches from 1e4; the bump makes [3e4, 8e4] fail again
  model.disturbance = [](double c, double) { return c > 3e4 && c < 8e4 ? 1.0 : 0.0; };
  const TuningResult result = run(model);
  EXPECT_NEAR(decades(result.point.at(0), model.ends().low), 0.5 * kResolution, 0.5 * kResolution);
  EXPECT_NEAR(decades(result.window->high, 3e4), -0.5 * kResolution, 0.51 * kResolution);
  EXPECT_FALSE(result.notes.empty());
}

TEST(Tune, Moves_up_until_half_the_step_matches_too) {
  SyntheticError model;  // half the step has 1.3 times the error: boundary 1.3 times higher
  model.disturbance = [](double, double h) { return h < 0.7e-4 ? std::log10(1.3) : 0.0; };
  model.terms = {{200.0, 0.0}};
  const TuningResult result = run(model);
  EXPECT_NEAR(decades(result.point.at(0), 1.3e4), 0.5 * kResolution, 0.5 * kResolution);
  EXPECT_EQ(result.certificate->claims[0].verdict, Verdict::certified);
  EXPECT_EQ(result.certificate->claims[1].verdict, Verdict::certified)
      << result.certificate->claims[1].reason;
}

TEST(Tune, Refutes_a_match_that_only_the_coarse_step_shows) {
  SyntheticError model;
  model.disturbance = [](double, double h) { return h < 0.7e-4 ? 6.0 : 0.0; };
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::refuted);
  EXPECT_EQ(result.certificate->claims[0].verdict, Verdict::refuted);
}

TEST(Tune, Treats_NaN_and_negative_errors_as_failures) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -1.0}) {
    SyntheticError model;
    const auto good = model.evaluator();
    const TuningResult result =
        tune(model.problem(), {}, [&](const std::vector<Request>& requests) {
          std::vector<Answer> answers = good(requests);
          for (std::size_t i = 0; i < answers.size(); ++i) {
            answers[i].errors[0] = requests[i].x[0] > 1e6 ? bad : answers[i].errors[0];
          }
          return answers;
        });
    EXPECT_EQ(result.status, TuningStatus::certified) << result.reason;
    EXPECT_NEAR(decades(result.window->high, 1e6), -0.5 * kResolution, 0.51 * kResolution);
    EXPECT_EQ(result.points.back().side, Side::failed);
  }
}

TEST(Tune, Leaves_the_claim_open_when_a_deciding_run_timed_out) {
  SyntheticError model;
  model.cause = [](double c, double) { return c < 9990.0 ? Cause::timeout : Cause::ok; };
  const TuningResult result = run(model);
  EXPECT_EQ(result.status, TuningStatus::inconclusive);
  EXPECT_EQ(result.certificate->claims[1].verdict, Verdict::inconclusive);
  EXPECT_NE(result.certificate->claims[1].reason.find("timeout"), std::string::npos);
}

TEST(Tune, Does_not_call_a_range_empty_that_only_timed_out) {
  SyntheticError model;
  model.cause = [](double, double) { return Cause::timeout; };
  EXPECT_EQ(run(model).status, TuningStatus::inconclusive);
}

TEST(Tune, Counts_a_failed_static_equilibrium_as_a_failing_point) {
  SyntheticError model;
  model.cause = [](double c, double) { return c < 5e4 ? Cause::statics_failed : Cause::ok; };
  const TuningResult result = run(model);
  EXPECT_NEAR(decades(result.point.at(0), 5e4), 0.5 * kResolution, 0.5 * kResolution);
  EXPECT_EQ(result.points.front().side, Side::failed);
  EXPECT_EQ(result.points.front().cause, Cause::statics_failed);
}

TEST(Tune, Asks_the_same_sequence_every_time) {
  SyntheticError first;
  SyntheticError second;
  first.disturbance = second.disturbance = testing::make_noise(5e-3);
  run(first);
  run(second);
  EXPECT_EQ(testing::sequence_of(first.asked), testing::sequence_of(second.asked));
}

TEST(Tune, Never_asks_for_a_point_twice_nor_for_one_outside_the_range) {
  SyntheticError model;
  model.disturbance = testing::make_noise(2e-2);
  run(model);
  std::set<std::pair<double, double>> seen;
  for (const Request& request : model.asked) {
    EXPECT_TRUE(seen.insert({request.x[0], request.step_factor}).second) << request.x[0];
    EXPECT_GE(request.x[0], 1e3);
    EXPECT_LE(request.x[0], 1e8);
  }
}

TEST(Tune, Finds_the_same_point_for_every_batch_size) {
  for (std::size_t batch = 1; batch <= 24; ++batch) {
    SyntheticError model;
    TuningOptions options;
    options.batch = batch;
    const TuningResult result = run(model, options);
    EXPECT_EQ(result.status, TuningStatus::certified) << batch << result.reason;
    EXPECT_NEAR(decades(result.point.at(0), model.ends().low), 0.5 * kResolution, 0.5 * kResolution)
        << batch;
    EXPECT_LE(*std::max_element(model.batches.begin(), model.batches.end()), batch);
    EXPECT_EQ(result.rounds, model.batches.size());
  }
}

TEST(Tune, Spends_its_budget_exactly_and_then_is_inconclusive) {
  SyntheticError unlimited;
  const std::size_t needed = run(unlimited).observations.size();
  for (std::size_t budget = 1; budget < needed; ++budget) {
    SyntheticError model;
    TuningOptions options;
    options.max_evaluations = budget;
    const TuningResult result = run(model, options);
    ASSERT_LE(model.asked.size(), budget);
    ASSERT_EQ(result.observations.size(), model.asked.size());
    if (result.status != TuningStatus::certified) {
      ASSERT_EQ(model.asked.size(), budget);
      ASSERT_EQ(result.status, TuningStatus::inconclusive);
      ASSERT_NE(result.reason.find("max_evaluations"), std::string::npos) << result.reason;
    }
    if (budget >= 5) {  // 1e3, 2.2e3, 4.6e3, 1e4, 2.2e4: the fifth point of the scan matches
      ASSERT_FALSE(result.point.empty()) << budget;
      ASSERT_GE(result.point[0], model.ends().low);
    }
  }
}

TEST(Tune, Lets_an_exception_of_the_evaluations_through) {
  SyntheticError probe;
  run(probe);
  const std::size_t last = probe.asked.size();
  for (std::size_t limit = 0; limit < last; ++limit) {
    SyntheticError model;
    const auto good = model.evaluator();
    const EvaluateBatch throwing = [&](const std::vector<Request>& requests) {
      if (model.asked.size() + requests.size() > limit) throw std::domain_error("interrupted");
      return good(requests);
    };
    EXPECT_THROW(tune(model.problem(), {}, throwing), std::domain_error) << limit;
  }
}

TEST(Tune, Rejects_answers_of_the_wrong_shape) {
  SyntheticError model;
  const auto none = [](const std::vector<Request>&) { return std::vector<Answer>{}; };
  EXPECT_THROW(tune(model.problem(), {}, none), std::logic_error);
  const auto good = model.evaluator();
  const auto two_errors = [&](const std::vector<Request>& requests) {
    std::vector<Answer> answers = good(requests);
    answers.back().errors.push_back(0.0);
    return answers;
  };
  EXPECT_THROW(tune(model.problem(), {}, two_errors), std::logic_error);
}

TEST(Tune, Refuses_a_problem_it_cannot_solve) {
  SyntheticError model;
  TuningProblem none = model.problem();
  none.variables.clear();
  EXPECT_THROW(tune(none, {}, model.evaluator()), std::invalid_argument);
  TuningProblem wrong = model.problem(-1.0, 1.0);
  wrong.components.push_back(wrong.components.front());
  wrong.components.front().tolerance = 0.0;
  TuningOptions options;
  options.scan = 1;
  options.batch = 0;
  options.delta = 1e-4;  // finer than the resolution of 1e-3 decades
  EXPECT_EQ(check(wrong, options).size(), 6U);
  EXPECT_TRUE(check(model.problem(), {}).empty());
  EXPECT_TRUE(model.asked.empty());
}

}  // namespace
}  // namespace linkstudy::tuning::tune_test
