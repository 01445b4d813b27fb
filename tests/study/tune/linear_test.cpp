// Linear ranges: values that may be zero or negative, with planted answers in closed form.
#include "study/tune/scan_window.h"
#include "study/tune/search_section.h"
#include "study/tune/variable_axis.h"
#include "study/tune/write_tuning.h"
#include "synthetic_error.h"

namespace linkstudy::tuning::linear_test {
namespace {

using Values = std::vector<double>;

struct PlantedErrors {
  TuningProblem problem;
  std::function<Values(const Values& x)> ratios;  // error over tolerance
  Values smallest, largest;                       // of what was asked
  std::size_t asked = 0;

  TuningResult run(TuningOptions options = {}) {
    smallest = largest = {};
    return tune(problem, options, [this](const std::vector<Request>& requests) {
      std::vector<Answer> answers;
      for (const Request& request : requests) {
        Answer answer{asked++, Cause::ok, {}, {}, 0.1, 1e-3, 1e-4 * request.step_factor};
        for (const double ratio : ratios(request.x)) answer.errors.push_back(0.02 * ratio);
        answers.push_back(std::move(answer));
        for (std::size_t j = 0; j < request.x.size(); ++j) {
          smallest.resize(request.x.size(), request.x[j]);
          largest.resize(request.x.size(), request.x[j]);
          smallest[j] = std::min(smallest[j], request.x[j]);
          largest[j] = std::max(largest[j], request.x[j]);
        }
      }
      return answers;
    });
  }
};

TunedVariable linear(const char* path, double low, double high, double weight = 1.0) {
  return {path, "m", low, high, weight, false};
}

TEST(LinearAxis, Goes_back_and_forth_with_exact_ends) {
  const TunedVariable variable = linear("x", -0.3, 0.7);
  EXPECT_EQ(from_axis(variable, position_of(variable, variable.low)), variable.low);
  EXPECT_EQ(from_axis(variable, position_of(variable, variable.high)), variable.high);
  EXPECT_NEAR(distance(variable, -0.1, 0.3), 0.4, 1e-15);
  EXPECT_NEAR(shifted(variable, 0.0, 0.25), 0.25, 1e-15);
  EXPECT_NEAR(midway(variable, -0.1, 0.3), 0.1, 1e-15);
  const std::vector<double> scan = make_scan_values(variable, 11);
  EXPECT_EQ(scan.front(), -0.3);
  EXPECT_EQ(scan.back(), 0.7);
  for (std::size_t i = 1; i < scan.size(); ++i) EXPECT_NEAR(scan[i] - scan[i - 1], 0.1, 1e-15);
}

// ratio = 1 at x0, falling with slopes that differ by ten times over the range. 0.001: the
// resolution, of a range of length 1.
TEST(LinearTune, Finds_the_lowest_value_of_a_range_through_zero) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const double low = -0.9 + 0.8 * unit(generator);
    const double x0 = low + 0.15 + 0.7 * unit(generator);
    const double steepness = 0.5 * std::pow(10.0, 1.5 * unit(generator));
    PlantedErrors planted;
    planted.problem.variables = {linear("x", low, low + 1.0)};
    planted.problem.components = {{"e", 0.02}};
    planted.ratios = [=](const Values& x) { return Values{std::exp(steepness * (x0 - x[0]))}; };
    const TuningResult result = planted.run();
    ASSERT_EQ(result.status, TuningStatus::certified) << i << ": " << result.reason;
    EXPECT_GE(result.point[0], x0) << i;
    EXPECT_LE(result.point[0], x0 + 1e-3) << i;
    EXPECT_EQ(shown_objective(result), result.point[0]) << i;
    EXPECT_NEAR(result.window->margin, low + 1.0 - result.point[0], 1e-12) << i;
    EXPECT_GE(planted.smallest[0], low) << i;
    EXPECT_LE(planted.largest[0], low + 1.0) << i;
    EXPECT_LT(planted.asked, 150U) << i;
  }
}

// Half of delta above the end of the range, beyond which there are no values.
TEST(LinearTune, Is_certified_beside_an_end_of_its_range_that_fails) {
  PlantedErrors planted;
  planted.problem.variables = {linear("x", 0.0, 1.0)};
  planted.problem.components = {{"e", 0.02}};
  planted.ratios = [](const Values& x) { return Values{std::exp(5.0 * (0.01 - x[0]))}; };
  const TuningResult result = planted.run();
  EXPECT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_NEAR(result.point[0], 0.01, 1e-3);
  EXPECT_EQ(planted.smallest[0], 0.0);
  planted.ratios = [](const Values& x) { return Values{std::exp(5.0 * (-0.01 - x[0]))}; };
  const TuningResult open = planted.run();
  EXPECT_EQ(open.status, TuningStatus::inconclusive);
  EXPECT_NE(open.reason.find("the range of 'x' ends at 0, where k lies"), std::string::npos)
      << open.reason;
}

// Between two points of the scan, and steeper than any 1/c over a decade.
TEST(LinearTune, Finds_a_window_that_the_scan_misses_and_says_where_there_is_none) {
  PlantedErrors planted;
  planted.problem.variables = {linear("x", -2.0, 2.0)};
  planted.problem.components = {{"e", 0.02}};
  for (const double least : {0.9, 1.5}) {
    planted.ratios = [=](const Values& x) {
      return Values{least * std::exp(20.0 * std::abs(x[0] - 0.111))};
    };
    const TuningResult result = planted.run();
    if (least > 1.0) {
      EXPECT_EQ(result.status, TuningStatus::infeasible) << result.reason;
      EXPECT_NE(result.reason.find("misses by a factor of 1."), std::string::npos) << result.reason;
      EXPECT_FALSE(result.suggestion);
    } else {
      ASSERT_FALSE(result.point.empty()) << result.reason;
      // exp(20 d) = 1 / 0.9; 0.004: the resolution, of a range of length 4.
      EXPECT_NEAR(result.point[0], 0.111 - std::log(1.0 / 0.9) / 20.0, 0.004);
    }
  }
}

// The largest x that matches while z is free between negative and positive values: x0, at z0.
TEST(LinearTune, Finds_the_largest_value_while_another_is_free) {
  PlantedErrors planted;
  planted.problem.variables = {linear("x", 0.0, 0.5, -1.0), linear("z", -1.0, 3.0, 0.0)};
  planted.problem.components = {{"e", 0.02}};
  planted.ratios = [](const Values& x) {
    return Values{std::exp(8.0 * (x[0] - 0.2) + 0.5 * (x[1] + 0.4) * (x[1] + 0.4))};
  };
  const TuningResult result = planted.run();
  EXPECT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_LE(result.point[0], 0.2 + 1e-12);
  EXPECT_GT(result.point[0], 0.2 - 2e-3);
  // Within 0.002 of x the error changes by 1.6 %, and so it does 0.18 from z0.
  EXPECT_NEAR(result.point[1], -0.4, 0.18);
  EXPECT_EQ(shown_objective(result), result.point[0]);
}

TEST(LinearTune, Is_written_without_decades) {
  PlantedErrors planted;
  planted.problem.variables = {linear("x", -1.0, 1.0)};
  planted.problem.components = {{"e", 0.02}};
  planted.ratios = [](const Values& x) { return Values{std::exp(3.0 * (-0.5 - x[0]))}; };
  const TuningResult result = planted.run();
  const std::string text = write_text(result);
  EXPECT_NE(text.find("75 % of the range"), std::string::npos) << text;
  EXPECT_EQ(text.find("log10"), std::string::npos) << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  EXPECT_NE(text.find("k - 0.02 of its range, or its end, fails"), std::string::npos) << text;
  EXPECT_NE(write_json(result, "").find("\"margin_decades\":null"), std::string::npos);
}

TEST(LinearTune, Refuses_a_sum_with_other_values) {
  TuningProblem problem;
  problem.variables = {linear("x", -1.0, 1.0), {"k", "N/m", 1e3, 1e6}};
  problem.components = {{"e", 0.02}};
  ASSERT_EQ(check(problem, {}).size(), 1U);
  EXPECT_EQ(check(problem, {}).front().path, "objective");
  problem.variables.pop_back();
  EXPECT_TRUE(check(problem, {}).empty());
  problem.variables[0].low = 1.0;
  EXPECT_EQ(check(problem, {}).size(), 1U);
}

}  // namespace
}  // namespace linkstudy::tuning::linear_test
