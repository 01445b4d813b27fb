#include "study/tune/search_section.h"

#include "study/tune/scan_window.h"
#include "study/tune/suggest_step.h"
#include "synthetic_error.h"

namespace linkstudy::tuning::search_test {
namespace {

using testing::decades;
using testing::SyntheticError;

TEST(SectionSearch, Places_a_pure_power_law_in_one_round) {
  for (const double slope : {-2.0, -1.0, -0.5, -0.3}) {
    // Ratio 1 at 2e4, so log ratio = slope * log10(c / 2e4).
    const Bracket bracket{1e4, 3e4};
    const EndRatios ends{slope * decades(1e4, 2e4), slope * decades(3e4, 2e4)};
    const SectionSettings settings{WindowEnd::lower, Steps::base, 1e-3, ""};
    const std::vector<double> values = place_section(bracket, ends, settings, 2, false);
    ASSERT_EQ(values.size(), 2U);
    EXPECT_LT(values[0], 2e4);
    EXPECT_GT(values[1], 2e4);
    EXPECT_LE(decades(values[1], values[0]), 1e-3);
  }
}

TEST(SectionSearch, Keeps_its_places_inside_the_bracket_apart_and_within_the_count) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const bool lower = unit(generator) < 0.5;
    const double a = std::pow(10.0, 3.0 + 3.0 * unit(generator));
    const double b = a * std::pow(10.0, 1e-3 + 0.5 * unit(generator));
    const Bracket bracket = lower ? Bracket{a, b} : Bracket{b, a};
    const EndRatios ends{std::pow(10.0, 4.0 * unit(generator) - 2.9), -5.0 * unit(generator)};
    const SectionSettings settings{lower ? WindowEnd::lower : WindowEnd::upper, Steps::base, 1e-3,
                                   ""};
    const auto count = static_cast<std::size_t>(1.0 + 15.0 * unit(generator));
    const std::vector<double> values =
        place_section(bracket, ends, settings, count, unit(generator) < 0.3);
    ASSERT_FALSE(values.empty());
    ASSERT_LE(values.size(), count);
    ASSERT_GT(values.front(), a);
    ASSERT_LT(values.back(), b);
    ASSERT_TRUE(std::is_sorted(values.begin(), values.end(), std::less_equal<double>()));
  }
}

TEST(SectionSearch, Closes_on_a_boundary_without_slope) {
  // A cliff: the secant knows nothing, and sections alone must do it.
  for (const std::size_t batch : {1U, 2U, 3U, 8U}) {
    SyntheticError model;
    model.cause = [](double c, double) { return c < 33333.0 ? Cause::diverged : Cause::ok; };
    TuningOptions options;
    options.batch = batch;
    EvaluationLog log(model.problem(), options, model.evaluator());
    log.evaluate({{{1e4}, 1.0, "scan"}, {{5e4}, 1.0, "scan"}});
    const Bracket end =
        search_section(log, {1e4, 5e4}, {WindowEnd::lower, Steps::base, 1e-3, "lower_end"});
    EXPECT_LE(width_of({}, end), 1e-3);
    EXPECT_LT(end.failing, 33333.0);
    EXPECT_GE(end.feasible, 33333.0);
    // 0.7 decades / 1e-3 = 2^9.5: ten bisections at most when asked one by one.
    EXPECT_LE(model.batches.size(), 2U + 10U);
  }
}

TEST(SectionSearch, Is_not_slowed_by_a_secant_that_misleads) {
  // A finite cliff: 1.01 of the tolerance below, 1e-6 above. The secant points at the failing end
  // whatever the bracket, so one by one every other place must be the middle.
  SyntheticError model;
  model.terms = {{0.0, 0.0}};
  TuningOptions options;
  options.batch = 1;
  const auto answers = model.evaluator();
  EvaluationLog log(model.problem(), options, [&](const std::vector<Request>& requests) {
    std::vector<Answer> changed = answers(requests);
    for (std::size_t i = 0; i < changed.size(); ++i) {
      changed[i].errors[0] = requests[i].x[0] < 33333.0 ? 0.0202 : 2e-8;
    }
    return changed;
  });
  log.evaluate({{{1e4}, 1.0, "scan"}, {{5e4}, 1.0, "scan"}});
  const Bracket end =
      search_section(log, {1e4, 5e4}, {WindowEnd::lower, Steps::base, 1e-3, "lower_end"});
  EXPECT_GE(end.feasible, 33333.0);
  EXPECT_LE(width_of({}, end), 1e-3);
  EXPECT_LE(model.asked.size(), 2U + 20U);  // twice the ten bisections of 0.7 / 1e-3 = 2^9.5
}

TEST(SectionSearch, Takes_few_rounds_on_a_falling_error) {
  for (const std::size_t batch : {1U, 2U, 8U}) {
    SyntheticError model;
    TuningOptions options;
    options.batch = batch;
    EvaluationLog log(model.problem(), options, model.evaluator());
    log.evaluate({{{5e3}, 1.0, "scan"}, {{2e4}, 1.0, "scan"}});
    const std::size_t before = model.batches.size();
    const Bracket end =
        search_section(log, {5e3, 2e4}, {WindowEnd::lower, Steps::base, 1e-3, "lower_end"});
    EXPECT_NEAR(decades(end.feasible, model.ends().low), 0.5e-3, 0.5e-3);
    EXPECT_LE(model.batches.size() - before, batch == 1 ? 5U : 2U);
  }
}

TEST(WindowScan, Has_the_ends_of_the_range_and_equal_ratios) {
  const std::vector<double> values = make_scan_values({"k", "N/m", 1e3, 1e8}, 11);
  EXPECT_EQ(values.front(), 1e3);
  EXPECT_EQ(values.back(), 1e8);
  for (std::size_t i = 1; i < values.size(); ++i) {
    EXPECT_NEAR(decades(values[i], values[i - 1]), 0.5, 1e-12);
  }
}

TEST(WindowScan, Bounds_every_function_within_the_slopes_from_below) {
  // f falls by at most 2 and rises by at most 8: sampled piecewise-linear functions.
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> slope(-kSteepestFall, kSteepestRise);
  for (int i = 0; i < 500; ++i) {
    std::vector<double> f = {1.0};
    for (int j = 0; j < 10; ++j) f.push_back(f.back() + 0.1 * slope(generator));
    const IntervalBound bound = bound_between({}, 1.0, f.front(), 10.0, f.back());
    EXPECT_LE(bound.log_ratio, *std::min_element(f.begin(), f.end()) + 1e-12);
    EXPECT_GT(bound.value, 1.0);
    EXPECT_LT(bound.value, 10.0);
  }
}

TEST(WindowScan, Judges_each_failing_side_by_the_slope) {
  SyntheticError model;
  model.limit_scale = 1e-4 * std::sqrt(5e7);
  EvaluationLog log(model.problem(), {}, model.evaluator());
  std::vector<Request> requests;
  for (const double value : {2e3, 8e3, 1e5, 2e7, 4e7, 9e7}) {
    requests.push_back({{value}, 1.0, "scan"});
  }
  log.evaluate(requests);
  const std::vector<Side> expected = {Side::too_soft,        Side::too_soft,        Side::feasible,
                                      Side::step_too_coarse, Side::step_too_coarse, Side::diverged};
  const std::vector<ScanPoint> points = classify_points(log);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(points[i].side, expected[i]) << points[i].value;
  }
}

TEST(WindowScan, Does_not_blame_a_step_that_resolves_every_oscillation) {
  SyntheticError model;
  model.terms = {{200.0, 0.0}};
  model.step = 1e-8;  // h omega = 1e-8 sqrt(c) < 1e-4
  model.disturbance = [](double c, double) { return c > 1e6 ? 5.0 : 0.0; };
  EvaluationLog log(model.problem(), {}, model.evaluator());
  log.evaluate({{{1e5}, 1.0, "scan"}, {{1e7}, 1.0, "scan"}});
  EXPECT_EQ(classify_points(log).back().side, Side::too_soft);
}

TEST(ErrorModel, Recovers_both_coefficients_of_exact_samples) {
  std::vector<ErrorSample> samples;
  for (const double c : {1e4, 1e5, 1e6, 1e7}) {
    for (const double h : {1e-4, 5e-5}) {
      samples.push_back({c, h, 300.0 / c + 2.5 * c * c * std::pow(h, 4.0)});
    }
  }
  const ErrorModel model = fit_error_model(samples);
  EXPECT_NEAR(model.soft, 300.0, 1e-6);
  EXPECT_NEAR(model.coarse, 2.5, 1e-8);
}

TEST(ErrorModel, Never_has_a_negative_coefficient) {
  // Falls faster than 1/c: the best fit with both signs free would have B < 0.
  const ErrorModel falling =
      fit_error_model({{1e4, 1e-4, 1.0}, {1e5, 1e-4, 0.01}, {1e6, 1e-4, 1e-4}});
  EXPECT_GE(falling.soft, 0.0);
  EXPECT_GE(falling.coarse, 0.0);
  EXPECT_EQ(fit_error_model({}).soft, 0.0);
}

}  // namespace
}  // namespace linkstudy::tuning::search_test
