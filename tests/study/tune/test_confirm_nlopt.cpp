#include <chrono>
#include <thread>

#include "synthetic_error.h"

namespace linkstudy::tuning {
namespace {

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
  EXPECT_LE(confirmed.report.calls, 8U);  // it may finish the pair of calls it is in
  EXPECT_EQ(confirmed.report.ended, "stopped at the call limit");
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
    if (model.asked.size() == 3) {
      throw std::domain_error("interrupted");
    }
    return good(requests);
  });
  log.evaluate({{{3e4}, 1.0, "scan"}});
  EXPECT_THROW(confirm_with_nlopt(log, {3e4}, 0), std::domain_error);
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
}  // namespace linkstudy::tuning
