// Several tolerances and steps in one run, and how far the step may be raised at an answer.
#include <numeric>
#include <set>

#include "study/tune/step_reach.h"
#include "study/tune/tuning_tables.h"
#include "study/tune/write_tuning.h"
#include "synthetic_error.h"

namespace linkstudy::tuning::targets_test {
namespace {

using testing::decades;
using testing::solve_ends;
using testing::SyntheticError;
using testing::Term;

std::vector<TuningTarget> targets_of(const SyntheticError& model,
                                     const std::vector<double>& tolerances,
                                     const std::vector<double>& factors) {
  std::vector<TuningTarget> targets;
  for (const double factor : factors) {
    for (const double tolerance : tolerances) {
      targets.push_back({model.problem(), factor});
      for (MatchComponent& component : targets.back().problem.components) {
        component.tolerance = tolerance;
      }
    }
  }
  return targets;
}

// 0.001 decades: the resolution of the search.
TEST(Targets, Every_tolerance_gets_its_own_window_in_closed_form) {
  SyntheticError model;
  const std::vector<double> tolerances = {0.02, 0.01, 0.005};
  const auto results = tune(targets_of(model, tolerances, {1.0}), {}, model.evaluator());
  ASSERT_EQ(results.size(), 3U);
  for (std::size_t i = 0; i < results.size(); ++i) {
    ASSERT_EQ(results[i].status, TuningStatus::certified) << results[i].reason;
    const auto ends = solve_ends({200.0, 1.0, tolerances[i]}, model.step);
    EXPECT_GE(results[i].point[0], ends.low);
    EXPECT_LT(decades(results[i].point[0], ends.low), 0.001);
    EXPECT_LT(std::abs(decades(results[i].window->high, ends.high)), 0.001);
    EXPECT_EQ(tolerance_of(results[i]), tolerances[i]);
  }
}

TEST(Targets, Nothing_is_asked_twice_and_each_answer_is_what_it_is_alone) {
  SyntheticError model;
  const auto targets = targets_of(model, {0.02, 0.01}, {1.0});
  const auto together = tune(targets, {}, model.evaluator());
  std::set<std::pair<std::vector<double>, double>> asked;
  for (const Request& request : model.asked) {
    EXPECT_TRUE(asked.emplace(request.x, request.step_factor).second) << request.x.front();
  }
  const std::size_t both = together[0].observations.size() + together[1].observations.size();
  EXPECT_LE(model.asked.size(), both - 16U);  // one scan serves both, at least
  for (std::size_t i = 0; i < targets.size(); ++i) {
    SyntheticError fresh = model;
    const TuningResult alone = tune(targets[i].problem, {}, fresh.evaluator());
    EXPECT_EQ(alone.point, together[i].point);
    EXPECT_EQ(alone.window->high, together[i].window->high);
    EXPECT_EQ(alone.observations.size(), together[i].observations.size());
  }
}

TEST(Targets, Every_step_gets_its_own_window_in_closed_form) {
  SyntheticError model;
  const std::vector<double> factors = {0.5, 1.0, 4.0};
  const auto results = tune(targets_of(model, {0.02}, factors), {}, model.evaluator());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto ends = solve_ends({200.0, 1.0, 0.02}, factors[i] * model.step);
    ASSERT_EQ(results[i].status, TuningStatus::certified) << results[i].reason;
    EXPECT_LT(std::abs(decades(results[i].point[0], ends.low)), 0.001) << factors[i];
    EXPECT_LT(std::abs(decades(results[i].window->high, ends.high)), 0.001) << factors[i];
    EXPECT_DOUBLE_EQ(step_of(results[i]), factors[i] * model.step);
  }
}

// With h = 1.6e-2 s the two parts of the error are never under 0.02 together: 3 (A^2 B h^4 /
// 4)^(1/3) = 0.026 at the best stiffness.
TEST(Targets, A_step_without_a_window_is_infeasible_and_the_largest_one_with_is_named) {
  SyntheticError model;
  const double too_large = 160.0;
  const double least = 3.0 * std::cbrt(200.0 * 200.0 * std::pow(too_large * model.step, 4.0) / 4.0);
  ASSERT_GT(least, 0.02);
  const auto results =
      tune(targets_of(model, {0.02}, {1.0, 8.0, too_large}), {}, model.evaluator());
  EXPECT_EQ(results[1].status, TuningStatus::certified) << results[1].reason;
  EXPECT_EQ(results[2].status, TuningStatus::infeasible);
  EXPECT_EQ(worst_of(results), TuningStatus::infeasible);
  const std::string text = write_text(results);
  EXPECT_NE(text.find("the largest of these steps that matches is 0.0008 s"), std::string::npos)
      << text;
}

TEST(Targets, Tables_stand_one_under_the_other) {
  SyntheticError model;
  const auto results = tune(targets_of(model, {0.02, 0.01}, {1.0}), {}, model.evaluator());
  const std::vector<Table> tables = make_tables(results);
  const Table& answers = tables.front();
  ASSERT_EQ(row_count(answers), 2U);
  const Column* tolerance = find_column(answers, "target_tolerance");
  ASSERT_NE(tolerance, nullptr);
  EXPECT_EQ(std::get<std::vector<double>>(tolerance->values), (std::vector<double>{0.02, 0.01}));
  EXPECT_EQ(std::get<std::vector<double>>(find_column(answers, "value")->values),
            (std::vector<double>{results[0].point[0], results[1].point[0]}));
}

std::vector<int> multiples_up_to(int last) {
  std::vector<int> multiples(static_cast<std::size_t>(last - 1));
  std::iota(multiples.begin(), multiples.end(), 2);
  return multiples;
}

// A / c + B c^2 (m h)^4 <= tolerance, at the c that was found.
TEST(StepReach, Is_the_largest_multiple_in_closed_form) {
  for (const double coarse : {1.0, 1e-3, 1e-5}) {
    SyntheticError model;
    model.terms = {{200.0, coarse}};
    TuningOptions options;
    options.step_multiples = multiples_up_to(100);
    const TuningResult result = tune(model.problem(), options, model.evaluator());
    ASSERT_TRUE(result.step_reach);
    const double c = result.point[0];
    const auto matches = [&](int m) {
      return 200.0 / c + coarse * c * c * std::pow(m * model.step, 4.0) <= 0.02;
    };
    int largest = 1;
    while (largest < 100 && matches(largest + 1)) ++largest;
    EXPECT_NEAR(result.step_reach->step, largest * model.step, 1e-12) << coarse;
    if (largest == 100) continue;
    EXPECT_NEAR(result.step_reach->fails_at, (largest + 1) * model.step, 1e-12) << coarse;
    EXPECT_GT(result.step_reach->ratio, 1.0);
  }
}

TEST(StepReach, Ends_where_runs_diverge) {
  SyntheticError model;
  model.terms = {{230.0, 1e-12}};
  model.limit_scale = 5.5e-4 * std::sqrt(230.0 / 0.02);  // at the lower end of the window
  TuningOptions options;
  options.step_multiples = multiples_up_to(40);
  const TuningResult result = tune(model.problem(), options, model.evaluator());
  ASSERT_TRUE(result.step_reach);
  EXPECT_NEAR(result.step_reach->step, 5e-4, 1e-12);
  EXPECT_EQ(result.step_reach->cause, Cause::diverged);
  ASSERT_TRUE(result.first_failure);
  EXPECT_LE(result.first_failure->request.step_factor, 1.0) << "what is tried above is no failure";
}

TEST(StepReach, Says_so_where_all_multiples_match) {
  SyntheticError model;
  model.terms = {{200.0, 1e-15}};
  TuningOptions options;
  options.step_multiples = {2, 4, 5, 10};
  const TuningResult result = tune(model.problem(), options, model.evaluator());
  ASSERT_TRUE(result.step_reach);
  EXPECT_NEAR(result.step_reach->step, 10 * model.step, 1e-12);
  EXPECT_EQ(result.step_reach->fails_at, 0.0);
}

}  // namespace
}  // namespace linkstudy::tuning::targets_test
