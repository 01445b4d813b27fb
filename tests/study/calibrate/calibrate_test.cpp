#include "study/calibrate/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planted_model.h"

namespace linkstudy::calibration::calibrate_test {
namespace {

constexpr std::size_t kSamples = 400;

double time_of(std::size_t i) {
  return 0.01 * static_cast<double>(i);
}

// a exp(-b t) over 4 time units
std::vector<double> decay(const std::vector<double>& p) {
  std::vector<double> y;
  for (std::size_t i = 0; i < kSamples; ++i) y.push_back(p[0] * std::exp(-p[1] * time_of(i)));
  return y;
}

// e_t = rho e_(t-1) + sqrt(1 - rho^2) w_t: variance sigma^2 for every rho.
std::vector<double> with_noise(std::vector<double> y, double sigma, double rho,
                               std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  double e = normal(random);
  for (double& one : y) {
    one += sigma * e;
    e = rho * e + std::sqrt(1.0 - rho * rho) * normal(random);
  }
  return y;
}

FitProblem decay_problem() {
  return one_series({{"a", "N", false, 0.1, 10.0}, {"b", "1/s", true, 0.05, 20.0}}, kSamples);
}

// For fits that are meant to be wrong: what they miss is no noise.
FitOptions independent_errors() {
  FitOptions options;
  options.autocorrelation = Autocorrelation::none;
  return options;
}

struct Coverage {
  double profile = 0.0;
  double linear = 0.0;
};

Coverage find_coverage(double rho) {
  constexpr int kFits = 500;
  FitOptions options;
  options.starts = 2;  // one minimum: the starts are of no concern here
  const std::vector<double> truth = {2.0, 0.8};
  int profile = 0;
  int linear = 0;
  for (int i = 0; i < kFits; ++i) {
    const auto seed = static_cast<std::uint64_t>(1000 + i);
    const FitResult fit = calibrate(decay_problem(), options,
                                    evaluate_with(decay, with_noise(decay(truth), 0.1, rho, seed)));
    for (std::size_t k = 0; k < 2; ++k) {
      const Estimate& one = fit.estimates[k];
      const auto holds = [&](const Interval& interval) {
        return interval.low <= truth[k] && truth[k] <= interval.high;
      };
      profile += holds(one.profile) ? 1 : 0;
      linear += holds(one.linear) ? 1 : 0;
    }
  }
  return {profile / (2.0 * kFits), linear / (2.0 * kFits)};
}

// Two correlated shares of 500: a true coverage of 0.95 falls within 0.92 .. 0.98 but for 1 in 100.
TEST(Calibration, intervals_hold_the_truth_as_often_as_they_say_with_white_noise) {
  const Coverage coverage = find_coverage(0.0);
  RecordProperty("profile", std::to_string(coverage.profile));
  RecordProperty("linear", std::to_string(coverage.linear));
  EXPECT_THAT(coverage.profile, ::testing::AllOf(::testing::Ge(0.92), ::testing::Le(0.98)));
  EXPECT_THAT(coverage.linear, ::testing::AllOf(::testing::Ge(0.92), ::testing::Le(0.98)));
}

TEST(Calibration, intervals_hold_the_truth_as_often_as_they_say_with_correlated_noise) {
  const Coverage coverage = find_coverage(0.9);
  RecordProperty("profile", std::to_string(coverage.profile));
  RecordProperty("linear", std::to_string(coverage.linear));
  EXPECT_THAT(coverage.profile, ::testing::AllOf(::testing::Ge(0.92), ::testing::Le(0.98)));
  EXPECT_THAT(coverage.linear, ::testing::AllOf(::testing::Ge(0.92), ::testing::Le(0.98)));
}

TEST(Calibration, correlated_noise_leaves_few_effective_samples) {
  const FitResult fit = calibrate(decay_problem(), FitOptions(),
                                  evaluate_with(decay, with_noise(decay({2.0, 0.8}), 0.1, 0.9, 7)));
  // 400 (1 - 0.9) / (1 + 0.9) = 21; rho of 400 samples is known to sqrt((1 - rho^2) / n) = 0.02.
  EXPECT_NEAR(0.9, fit.figures.series[0].autocorrelation, 0.06);
  EXPECT_THAT(fit.figures.effective, ::testing::AllOf(::testing::Gt(8.0), ::testing::Lt(36.0)));
}

// x(t) of a mass on a spring depends on c / m alone.
TEST(Calibration, names_the_combination_of_a_planted_degeneracy) {
  const auto oscillation = [](const std::vector<double>& p) {
    std::vector<double> y;
    for (std::size_t i = 0; i < kSamples; ++i) {
      y.push_back(p[2] * std::cos(std::sqrt(p[1] / p[0]) * time_of(i)));
    }
    return y;
  };
  const FitProblem problem = one_series({{"mass", "kg", true, 0.1, 10.0},
                                         {"stiffness", "N/m", true, 0.2, 50.0},
                                         {"amplitude", "m", false, 0.1, 5.0}},
                                        kSamples);
  const FitResult fit =
      calibrate(problem, FitOptions(),
                evaluate_with(oscillation, with_noise(oscillation({1.0, 4.0, 1.0}), 0.01, 0.0, 3)));
  EXPECT_EQ(FitStatus::ambiguous, fit.status);
  EXPECT_THAT(fit.flat, ::testing::ElementsAre("mass : stiffness = 1 : 1"));
  EXPECT_EQ(Identifiability::structurally_flat, fit.estimates[0].identifiability);
  EXPECT_EQ(Identifiability::structurally_flat, fit.estimates[1].identifiability);
  EXPECT_EQ("mass : stiffness = 1 : 1", fit.estimates[1].combination);
  EXPECT_TRUE(std::isnan(fit.estimates[0].profile.low));
  EXPECT_EQ(Identifiability::identifiable, fit.estimates[2].identifiability);
  EXPECT_NEAR(1.0, fit.estimates[2].value, 0.005);
  EXPECT_NEAR(4.0, fit.estimates[1].value / fit.estimates[0].value, 0.01);
}

TEST(Calibration, finds_the_minimum_where_half_of_the_starts_fail) {
  const std::vector<double> measured = with_noise(decay({2.0, 0.8}), 0.01, 0.0, 5);
  const auto fails = [](const std::vector<double>& p) { return p[1] > 1.0; };
  const FitResult fit =
      calibrate(decay_problem(), FitOptions(), evaluate_with(decay, measured, fails));
  EXPECT_EQ(FitStatus::fitted, fit.status) << fit.reason;
  EXPECT_NEAR(0.8, fit.estimates[1].value, 0.01);
  EXPECT_GT(fit.failed, 5u);
  const auto failed = std::ranges::count(fit.starts, DescentEnd::start_failed, &StartReport::end);
  EXPECT_GT(failed, 5);
  EXPECT_EQ(20, std::ssize(fit.starts) - failed);
}

// The minimum lies beyond the edge of what runs: what is found is the edge, and said so.
TEST(Calibration, ends_beside_a_failing_region_that_hides_the_minimum) {
  const auto fails = [](const std::vector<double>& p) { return p[1] > 0.7; };
  const std::vector<double> measured = with_noise(decay({2.0, 0.8}), 0.01, 0.0, 5);
  const FitResult fit =
      calibrate(decay_problem(), independent_errors(), evaluate_with(decay, measured, fails));
  EXPECT_EQ(FitStatus::ambiguous, fit.status);
  EXPECT_NEAR(0.7, fit.estimates[1].value, 1e-3);
  EXPECT_EQ(ProfileEnd::failed, fit.estimates[1].high_end);
  EXPECT_EQ(Identifiability::practically_not, fit.estimates[1].identifiability);
}

TEST(Calibration, says_the_cause_where_every_run_fails) {
  const FitResult fit = calibrate(
      decay_problem(), FitOptions(),
      evaluate_with(decay, decay({2.0, 0.8}), [](const std::vector<double>&) { return true; }));
  EXPECT_EQ(FitStatus::failed, fit.status);
  EXPECT_EQ("every start failed; the first: diverged: planted", fit.reason);
  EXPECT_EQ(100u, fit.evaluations);
}

TEST(Calibration, gives_no_interval_across_a_bound) {
  FitProblem problem = decay_problem();
  problem.parameters[0].low = 2.5;  // the truth is 2
  const FitResult fit =
      calibrate(problem, independent_errors(),
                evaluate_with(decay, with_noise(decay({2.0, 0.8}), 0.01, 0.0, 5)));
  const Estimate& one = fit.estimates[0];
  EXPECT_EQ(2.5, one.value);
  EXPECT_EQ(AtBound::low, one.at_bound);
  EXPECT_EQ(ProfileEnd::bound, one.low_end);
  EXPECT_TRUE(std::isnan(one.profile.low));
  EXPECT_TRUE(std::isnan(one.linear.low));
  EXPECT_GT(one.profile.high, 2.5);
}

// A bound just beyond the estimate cuts the interval off: that end is not known.
TEST(Calibration, leaves_open_the_end_that_a_bound_cuts_off) {
  const std::vector<double> measured = with_noise(decay({2.0, 0.8}), 0.1, 0.0, 11);
  const FitResult free = calibrate(decay_problem(), FitOptions(), evaluate_with(decay, measured));
  FitProblem problem = decay_problem();
  problem.parameters[0].high = 0.5 * (free.estimates[0].value + free.estimates[0].profile.high);
  const FitResult fit = calibrate(problem, FitOptions(), evaluate_with(decay, measured));
  EXPECT_NEAR(free.estimates[0].value, fit.estimates[0].value, 1e-6);
  EXPECT_EQ(AtBound::no, fit.estimates[0].at_bound);
  EXPECT_EQ(ProfileEnd::bound, fit.estimates[0].high_end);
  EXPECT_TRUE(std::isnan(fit.estimates[0].profile.high));
  EXPECT_TRUE(std::isnan(fit.estimates[0].linear.high));
  EXPECT_EQ(Identifiability::practically_not, fit.estimates[0].identifiability);
}

TEST(Calibration, recovers_the_parameters_of_data_without_noise_to_the_last_digits) {
  const FitResult fit =
      calibrate(decay_problem(), FitOptions(), evaluate_with(decay, decay({2.0, 0.8})));
  EXPECT_EQ(FitStatus::fitted, fit.status) << fit.reason;
  EXPECT_NEAR(2.0, fit.estimates[0].value, 1e-10);
  EXPECT_NEAR(0.8, fit.estimates[1].value, 1e-10);
  EXPECT_TRUE(fit.profiles.empty());
  EXPECT_TRUE(fit.check.confirms) << fit.check.sum;
  EXPECT_EQ(fit.starts.size(),
            static_cast<std::size_t>(std::ranges::count(fit.starts, true, &StartReport::is_best)));
  EXPECT_EQ("the data are met to rounding, so that nothing tells of intervals", fit.reason);
}

// What a wrong model misses has no 400 independent samples.
TEST(Calibration, gives_no_intervals_where_the_residuals_are_one_long_wave) {
  FitProblem problem = decay_problem();
  problem.parameters[1].high = 0.1;
  const FitResult fit = calibrate(problem, FitOptions(), evaluate_with(decay, decay({2.0, 0.8})));
  EXPECT_EQ(FitStatus::ambiguous, fit.status);
  EXPECT_THAT(fit.reason, ::testing::StartsWith("the residuals are so correlated that"));
  EXPECT_TRUE(std::isnan(fit.estimates[0].linear.low));
}

TEST(Calibration, stops_at_its_budget_and_says_so) {
  FitOptions options;
  options.max_evaluations = 60;
  const FitResult fit = calibrate(decay_problem(), options,
                                  evaluate_with(decay, with_noise(decay({2.0, 0.8}), 0.1, 0.0, 5)));
  EXPECT_EQ(FitStatus::ambiguous, fit.status);
  EXPECT_EQ("the budget of 60 evaluations is used up", fit.reason);
  EXPECT_EQ(60u, fit.evaluations);
}

TEST(Calibration, passes_on_what_an_evaluation_throws) {
  int calls = 0;
  const EvaluateBatch good = evaluate_with(decay, with_noise(decay({2.0, 0.8}), 0.1, 0.0, 5));
  const auto count = [&](const std::vector<std::vector<double>>& points) {
    ++calls;
    return good(points);
  };
  calibrate(decay_problem(), FitOptions(), count);
  const int all = calls;
  for (const int limit : {0, 1, all / 2, all - 1}) {  // also inside NLopt
    int made = 0;
    const auto stop = [&](const std::vector<std::vector<double>>& points) {
      if (made++ == limit) throw std::runtime_error("stop");
      return good(points);
    };
    EXPECT_THROW(calibrate(decay_problem(), FitOptions(), stop), std::runtime_error) << limit;
  }
}

}  // namespace
}  // namespace linkstudy::calibration::calibrate_test
