// Other objectives than the lowest values: one of several values, a largest one, a response. The
// planted problems have their optimum in closed form.
#include <set>

#include "study/tune/tuning_result.h"
#include "synthetic_error.h"

namespace linkstudy::tuning::objective_test {
namespace {

using Values = std::vector<double>;

// Errors as log10 of error over tolerance, and a response.
struct PlantedErrors {
  TuningProblem problem;
  std::function<Values(const Values& t)> log_ratios;  // t: log10 of the values
  std::function<double(const Values& t)> response = [](const Values&) { return 0.0; };
  std::size_t asked = 0;

  TuningResult run(TuningOptions options = {}) {
    return tune(problem, options, [this](const std::vector<Request>& requests) {
      std::vector<Answer> answers;
      for (const Request& request : requests) {
        Answer answer{asked++, Cause::ok, {}, {}, 0.1, 1e-3, 1e-4 * request.step_factor};
        Values t;
        for (const double x : request.x) t.push_back(std::log10(x));
        for (const double ratio : log_ratios(t)) {
          answer.errors.push_back(0.02 * std::pow(10.0, ratio));
        }
        answer.objective = response(t);
        answers.push_back(std::move(answer));
      }
      return answers;
    });
  }
};

TunedVariable variable(const char* path, double low, double high, double weight) {
  return {path, "", low, high, weight};
}

// ratio = (k0 / k) 10^(a (log z - z0)^2): the lowest k is k0, at z0. 0.005 decades of k: the free
// value is found to where 0.001 decades of it no longer change the error by 1e-4.
TEST(Objective, Lowest_of_one_value_while_another_is_free) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 30; ++i) {
    const double k0 = 4.0 + 2.5 * unit(generator);
    const double z0 = -1.0 + 1.5 * unit(generator);
    const double a = 0.05 + 0.5 * unit(generator);
    PlantedErrors planted;
    planted.problem.variables = {variable("k", 1e3, 1e8, 1.0), variable("z", 0.05, 5.0, 0.0)};
    planted.problem.components = {{"e", 0.02}};
    planted.log_ratios = [=](const Values& t) {
      return Values{k0 - t[0] + a * (t[1] - z0) * (t[1] - z0)};
    };
    const TuningResult result = planted.run();
    ASSERT_EQ(result.status, TuningStatus::certified) << i << ": " << result.reason;
    EXPECT_GE(std::log10(result.point[0]), k0 - 1e-12) << i;
    EXPECT_LT(std::log10(result.point[0]) - k0, 0.005) << i;
    EXPECT_NEAR(shown_objective(result), result.point[0], 0.0);
    EXPECT_LT(planted.asked, 600U) << i;
  }
}

// The error grows with the value: the largest is asked for.
TEST(Objective, Largest_of_one_value) {
  for (const double x0 : {-4.3, -3.0, -2.2}) {
    PlantedErrors planted;
    planted.problem.variables = {variable("c", 1e-6, 1e-1, -1.0)};
    planted.problem.components = {{"e", 0.02}};
    planted.log_ratios = [=](const Values& t) { return Values{2.0 * (t[0] - x0)}; };
    const TuningResult result = planted.run();
    ASSERT_EQ(result.status, TuningStatus::certified) << result.reason;
    EXPECT_LE(std::log10(result.point[0]), x0 + 1e-12);
    EXPECT_GT(std::log10(result.point[0]), x0 - 0.003);
    ASSERT_TRUE(result.window);
    EXPECT_TRUE(result.window->low_open);
    EXPECT_EQ(shown_objective(result), result.point[0]);
  }
}

// Largest clearance with the stiffness free between two walls.
TEST(Objective, Largest_of_one_value_while_another_is_free) {
  PlantedErrors planted;
  planted.problem.variables = {variable("k", 1e3, 1e8, 0.0), variable("c", 1e-6, 1e-1, -1.0)};
  planted.problem.components = {{"e", 0.02}, {"f", 0.02}};
  // c <= 1e-3 (k / 1e5) and c <= 1e-3 (1e6 / k): both at k = 10^5.5.
  planted.log_ratios = [](const Values& t) {
    return Values{t[1] + 3.0 - (t[0] - 5.0), t[1] + 3.0 + (t[0] - 6.0)};
  };
  const TuningResult result = planted.run();
  ASSERT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_LE(std::log10(result.point[1]), -2.5 + 1e-12);
  EXPECT_GT(std::log10(result.point[1]), -2.5 - 0.02);
}

// The nearest point of the half plane s + t >= 10 to (4, 5): (4.5, 5.5), at a distance of
// sqrt(1/2).
TEST(Objective, A_response_is_minimised_over_what_matches) {
  PlantedErrors planted;
  planted.problem.variables = {variable("a", 1e2, 1e8, 1.0), variable("b", 1e2, 1e8, 1.0)};
  planted.problem.components = {{"e", 0.02}};
  planted.problem.response = ResponseObjective{"peak", false};
  planted.log_ratios = [](const Values& t) { return Values{10.0 - t[0] - t[1]}; };
  planted.response = [](const Values& t) { return 7.0 + std::hypot(t[0] - 4.0, t[1] - 5.0); };
  const TuningResult result = planted.run();
  ASSERT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_NEAR(result.objective, 7.0 + std::sqrt(0.5), 0.005);
  EXPECT_GE(result.objective, 7.0 + std::sqrt(0.5) - 1e-9);
  std::set<std::string> claims;
  for (const Claim& claim : result.certificate->claims) claims.insert(claim.name);
  EXPECT_EQ(claims, (std::set<std::string>{"C0", "C1", "C2"}));
}

TEST(Objective, A_response_that_is_lower_elsewhere_on_the_scan_refutes) {
  PlantedErrors planted;
  planted.problem.variables = {variable("a", 1e2, 1e8, 1.0)};
  planted.problem.components = {{"e", 0.02}};
  planted.problem.response = ResponseObjective{"peak", false};
  // Matches everywhere; two valleys, the deeper one narrow and at a point of the scan (1e8).
  planted.log_ratios = [](const Values&) { return Values{-1.0}; };
  planted.response = [](const Values& t) {
    return std::min(2.0 + std::abs(t[0] - 4.0), 1.0 + 100.0 * std::abs(t[0] - 8.0));
  };
  const TuningResult result = planted.run();
  ASSERT_FALSE(result.point.empty());
  EXPECT_EQ(result.status, TuningStatus::certified) << result.reason;
  EXPECT_NEAR(result.objective, 1.0, 1e-9);
}

TEST(Objective, No_match_is_infeasible_whatever_the_objective) {
  PlantedErrors planted;
  planted.problem.variables = {variable("k", 1e3, 1e8, 1.0), variable("z", 0.05, 5.0, 0.0)};
  planted.problem.components = {{"e", 0.02}};
  planted.log_ratios = [](const Values& t) { return Values{9.0 - t[0]}; };
  EXPECT_EQ(planted.run().status, TuningStatus::infeasible);
}

TEST(Objective, The_end_of_the_range_is_no_optimum) {
  PlantedErrors planted;
  planted.problem.variables = {variable("c", 1e-6, 1e-1, -1.0)};
  planted.problem.components = {{"e", 0.02}};
  planted.log_ratios = [](const Values&) { return Values{-0.5}; };
  const TuningResult result = planted.run();
  EXPECT_EQ(result.status, TuningStatus::inconclusive);
  EXPECT_NE(result.reason.find("raise its high end"), std::string::npos) << result.reason;
}

}  // namespace
}  // namespace linkstudy::tuning::objective_test
