#include <chrono>
#include <thread>

#include "synthetic_error.h"

namespace linkstudy::tuning::confirm_nlopt_test {
namespace {

using testing::decades;
using testing::SyntheticError;

struct Confirmed {
  NloptReport report;
  std::size_t asked = 0;
};

Confirmed confirm(SyntheticError& model, double start, TuningOptions options = {}) {
  EvaluationLog log(model.problem(), options, model.evaluator());
  log.evaluate({{{start}, 1.0, "scan"}});
  Confirmed confirmed{confirm_with_nlopt(log, {start}, 0), 0};
  confirmed.asked = model.asked.size() - 1;
  return confirmed;
}

TEST(NLopt, Finds_nothing_lower_than_the_closed_form_boundary) {
  SyntheticError model;
  const double start = model.ends().low * (1.0 + 1e-9);
  const Confirmed confirmed = confirm(model, start);
  EXPECT_FALSE(confirmed.report.found_lower);
  EXPECT_EQ(confirmed.report.lowest, start);
  EXPECT_EQ(confirmed.report.evaluations, confirmed.asked);
  EXPECT_GT(confirmed.asked, 2U);
}

TEST(NLopt, Reports_something_lower_where_it_is) {
  SyntheticError model;
  const Confirmed confirmed = confirm(model, 3.0 * model.ends().low);
  EXPECT_TRUE(confirmed.report.found_lower);
  EXPECT_LT(confirmed.report.lowest, 1.5 * model.ends().low);
  EXPECT_GE(confirmed.report.lowest, model.ends().low);
}

TEST(NLopt, Stops_at_our_evaluation_limit) {
  SyntheticError model;
  model.disturbance = testing::make_noise(0.3);
  for (std::size_t limit = 1; limit < 8; ++limit) {
    model.asked.clear();
    TuningOptions options;
    options.confirm_evaluations = limit;
    const Confirmed confirmed = confirm(model, 3.0 * model.ends().low, options);
    EXPECT_EQ(confirmed.asked, limit);
    EXPECT_EQ(confirmed.report.ended, "stopped at the evaluation limit");
  }
}

TEST(NLopt, Stops_at_our_call_limit) {
  SyntheticError model;
  TuningOptions options;
  options.confirm_calls = 6;
  const Confirmed confirmed = confirm(model, 3.0 * model.ends().low, options);
  // Each of the two algorithms may finish the pair of calls it is in.
  EXPECT_LE(confirmed.report.calls, 16U);
  EXPECT_FALSE(confirmed.report.verified);
  EXPECT_TRUE(confirmed.report.ended.ends_with("stopped at the call limit"))
      << confirmed.report.ended;
}

TEST(NLopt, Stops_at_our_time_limit) {
  SyntheticError model;
  model.cause = [](double, double) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return Cause::ok;
  };
  TuningOptions options;
  options.confirm_time_s = 0.03;
  const Confirmed confirmed = confirm(model, 30.0 * model.ends().low, options);
  EXPECT_EQ(confirmed.report.ended, "stopped at the time limit");
  EXPECT_LE(confirmed.asked, 3U);
}

TEST(NLopt, Survives_answers_that_are_all_failures_or_NaN) {
  SyntheticError model;
  model.cause = [](double c, double) { return c == 1e5 ? Cause::ok : Cause::diverged; };
  EXPECT_FALSE(confirm(model, 1e5).report.found_lower);
  model.cause = [](double, double) { return Cause::ok; };
  model.disturbance = [](double c, double) {
    return c == 1e5 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_FALSE(confirm(model, 1e5).report.found_lower);
}

TEST(NLopt, Survives_an_error_of_zero) {
  SyntheticError model;
  model.terms = {{0.0, 0.0}};
  const Confirmed confirmed = confirm(model, 1e5);
  EXPECT_TRUE(confirmed.report.found_lower);
  EXPECT_GE(confirmed.report.lowest, 1e3);
}

TEST(NLopt, Passes_an_exception_on_as_it_was) {
  SyntheticError model;
  const auto good = model.evaluator();
  EvaluationLog log(model.problem(), {}, [&](const std::vector<Request>& requests) {
    if (model.asked.size() == 3) throw std::domain_error("interrupted");
    return good(requests);
  });
  log.evaluate({{{3e4}, 1.0, "scan"}});
  EXPECT_THROW(confirm_with_nlopt(log, {3e4}, 0), std::domain_error);
}

// An error that falls in steps: on a step nothing tells COBYLA which way the boundary lies, and it
// returns a point below it that does not match.
SyntheticError make_stairs() {
  SyntheticError model;
  model.disturbance = [low = model.ends().low](double c, double) {
    const double above = decades(c, low);
    return above - 0.02 * std::floor(above / 0.02);
  };
  return model;
}

TEST(NLopt, Needs_no_second_opinion_where_COBYLA_verifies) {
  SyntheticError model;
  for (const double factor : {1.0 + 1e-9, 1.02, 1.5}) {
    const Confirmed confirmed = confirm(model, factor * model.ends().low);
    EXPECT_TRUE(confirmed.report.verified) << confirmed.report.ended;
    EXPECT_EQ(confirmed.report.algorithm, "COBYLA");
    EXPECT_EQ(confirmed.report.ended, "step tolerance reached");
  }
}

TEST(NLopt, Asks_an_augmented_Lagrangian_where_COBYLA_does_not_verify) {
  SyntheticError model = make_stairs();
  const double start = model.ends().low * (1.0 + 1e-9);
  const Confirmed confirmed = confirm(model, start);
  EXPECT_EQ(confirmed.report.algorithm, "AUGLAG with BOBYQA");
  EXPECT_TRUE(confirmed.report.ended.starts_with(
      "COBYLA not verified: it returned a point that does not match; "))
      << confirmed.report.ended;
  EXPECT_GT(confirmed.asked, 0U);
  EXPECT_EQ(confirmed.report.evaluations, confirmed.asked);
  EXPECT_LE(confirmed.asked, 2 * TuningOptions{}.confirm_evaluations);
  // The point in hand is the lowest there is, and stays.
  EXPECT_FALSE(confirmed.report.found_lower);
  EXPECT_EQ(confirmed.report.lowest, start);
}

TEST(NLopt, Keeps_the_lowest_match_either_algorithm_has_seen) {
  SyntheticError model = make_stairs();
  const double start = 30.0 * model.ends().low;
  const Confirmed confirmed = confirm(model, start);
  ASSERT_EQ(confirmed.report.algorithm, "AUGLAG with BOBYQA");
  double lowest = start;
  for (const Request& request : model.asked) {
    const bool matches = compute_ratio(model.answer(request, 0), model.problem().components) <= 1.0;
    if (matches) lowest = std::min(lowest, request.x.front());
  }
  EXPECT_EQ(confirmed.report.lowest, lowest);
  EXPECT_LT(lowest, 1.2 * model.ends().low);
  EXPECT_TRUE(confirmed.report.found_lower);
}

TEST(NLopt, Leaves_COBYLA_unverified_where_the_budget_ends) {
  SyntheticError model = make_stairs();
  const double start = model.ends().low * (1.0 + 1e-9);
  TuningOptions options;
  EvaluationLog log(model.problem(), options, model.evaluator());
  log.evaluate({{{start}, 1.0, "scan"}});
  const NloptReport whole = confirm_with_nlopt(log, {start}, 0);
  options.max_evaluations = 1 + whole.evaluations / 2;
  EvaluationLog small(model.problem(), options, model.evaluator());
  small.evaluate({{{start}, 1.0, "scan"}});
  const NloptReport cut = confirm_with_nlopt(small, {start}, 0);
  EXPECT_FALSE(cut.verified);
  EXPECT_EQ(small.remaining(), 0U);
  EXPECT_EQ(cut.lowest, start);
}

TEST(NLopt, Confirms_a_tuning_by_COBYLA_alone_where_that_verifies) {
  SyntheticError model;
  const TuningResult result = tune(model.problem(), {}, model.evaluator());
  EXPECT_EQ(result.status, TuningStatus::certified);
  EXPECT_TRUE(result.nlopt.verified);
  EXPECT_EQ(result.nlopt.algorithm, "COBYLA");
}

// The lowest step of the stairs that matches at half the time step as well.
TEST(NLopt, Does_not_move_the_answer_of_a_tuning_on_stairs) {
  SyntheticError model = make_stairs();
  const TuningResult result = tune(model.problem(), {}, model.evaluator());
  ASSERT_TRUE(result.window);
  EXPECT_GE(result.point.front(), model.ends().low);
  EXPECT_LE(decades(result.point.front(), model.ends().low), 0.02 + 1e-3);
}

TEST(NLopt, Leaves_the_reserve_of_the_budget_alone) {
  SyntheticError model;
  TuningOptions options;
  options.max_evaluations = 10;
  EvaluationLog log(model.problem(), options, model.evaluator());
  log.evaluate({{{3e5}, 1.0, "scan"}});
  confirm_with_nlopt(log, {3e5}, 6);
  EXPECT_GE(log.remaining(), 6U);
  EXPECT_FALSE(confirm_with_nlopt(log, {3e5}, 10).ran);
}

}  // namespace
}  // namespace linkstudy::tuning::confirm_nlopt_test
