// Several variables: planted problems whose optimum is known in closed form.
#include <stdexcept>

#include "study/tune/branch_and_bound.h"
#include "study/tune/lockstep.h"
#include "study/tune/monotone_proof.h"
#include "synthetic_error.h"

namespace linkstudy::tuning::box_test {
namespace {

// Component i has the error tol_i prod_j (k_ij / x_j)^w_ij: it matches where
// sum_j w_ij log10(x_j / k_ij) >= 0. The step adds `coarse` (h / h0)^4 (x_max / 1e8)^2.
struct PlantedBox {
  std::size_t n = 2;
  std::vector<std::vector<double>> weights;
  std::vector<std::vector<double>> corners;  // log10 k_ij
  double coarse = 0.02;
  std::function<double(const std::vector<double>&)> disturbance = [](const auto&) { return 0.0; };
  std::function<Cause(const std::vector<double>&)> cause = [](const auto&) { return Cause::ok; };
  std::size_t asked = 0;

  TuningProblem problem() const {
    TuningProblem result;
    for (std::size_t j = 0; j < n; ++j)
      result.variables.push_back({"c" + std::to_string(j), "N/m", 1e3, 1e8});
    for (std::size_t i = 0; i < weights.size(); ++i) {
      result.components.push_back({"e" + std::to_string(i), 0.02});
    }
    return result;
  }

  EvaluateBatch evaluator() {
    return [this](const std::vector<Request>& requests) {
      std::vector<Answer> answers;
      for (const Request& request : requests) {
        Answer answer{asked++, cause(request.x), {}, {}, 0.1, 1e-3, 1e-4 * request.step_factor};
        const double most = *std::max_element(request.x.begin(), request.x.end()) / 1e8;
        for (std::size_t i = 0; i < weights.size(); ++i) {
          double log_ratio = disturbance(request.x);
          for (std::size_t j = 0; j < n; ++j) {
            log_ratio += weights[i][j] * (corners[i][j] - std::log10(request.x[j]));
          }
          answer.errors.push_back(0.02 *
                                  (std::pow(10.0, log_ratio) +
                                   coarse * std::pow(request.step_factor, 4.0) * most * most));
        }
        answers.push_back(std::move(answer));
      }
      return answers;
    };
  }
};

TuningOptions box_options() {
  TuningOptions options;
  options.batch = 16;
  options.max_evaluations = 4000;
  return options;
}

// Each component asks for one value only: the optimum is the corner.
PlantedBox separable(std::size_t n, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> place(4.0, 6.5);
  PlantedBox box;
  box.n = n;
  for (std::size_t i = 0; i < n; ++i) {
    box.weights.emplace_back(n, 0.0);
    box.corners.emplace_back(n, 0.0);
    box.weights[i][i] = 1.0;
    box.corners[i][i] = place(generator);
  }
  return box;
}

double corner_sum(const PlantedBox& box) {
  double sum = 0.0;
  for (std::size_t i = 0; i < box.n; ++i) sum += box.corners[i][i];
  return sum;
}

// 0.02: the wanted distance; the step's part of the error moves the boundary by under 1e-3.
TEST(Box, Finds_and_proves_the_corner_of_planted_problems) {
  std::mt19937_64 generator(7);
  for (int i = 0; i < 12; ++i) {
    PlantedBox box = separable(2 + i % 2, generator);
    const TuningResult result = tune(box.problem(), box_options(), box.evaluator());
    ASSERT_EQ(result.status, TuningStatus::certified) << i << ": " << result.reason;
    EXPECT_GE(result.objective, corner_sum(box)) << i;
    EXPECT_LE(result.objective, corner_sum(box) + 0.02) << i;
    ASSERT_EQ(result.certificate->claims.size(), 5U);
    EXPECT_EQ(result.windows.size(), box.n);
    EXPECT_LT(result.observations.size(), 1000U) << i;
  }
}

TEST(Box, Every_answer_is_a_match_that_was_evaluated_whatever_the_ripple) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    PlantedBox box = separable(2 + i % 2, generator);
    // Up to 20 % of the tolerance.
    const double amplitude = std::log10(1.0 + 0.2 * unit(generator));
    const double wave = 5.0 + 60.0 * unit(generator);
    box.disturbance = [=](const std::vector<double>& x) {
      return amplitude * std::sin(wave * std::log10(x[0]) + std::log10(x[1]));
    };
    TuningOptions options = box_options();
    options.max_evaluations = 600;
    const TuningResult result = tune(box.problem(), options, box.evaluator());
    ASSERT_FALSE(result.point.empty()) << i;
    EXPECT_LE(compute_ratio(result.answer, result.problem.components), 1.0) << i;
    EXPECT_LE(box.asked, 600U) << i;
  }
}

TEST(Box, A_part_that_fails_by_a_cause_does_not_end_the_search) {
  std::mt19937_64 generator(5);
  PlantedBox box = separable(2, generator);
  box.coarse = 0.0;
  box.cause = [](const std::vector<double>& x) {
    return x[0] > 1e7 || x[1] < 3e3 ? Cause::diverged : Cause::ok;
  };
  const TuningResult result = tune(box.problem(), box_options(), box.evaluator());
  ASSERT_FALSE(result.point.empty());
  EXPECT_LE(result.objective, corner_sum(box) + 0.02);
  EXPECT_EQ(result.windows[0].high_limited_by, HighLimit::stability);
}

// Runs are stable up to 1e7 in each value; the optimum is at 1e6, 1e6. What has one value at 1e3
// and another above 1e7 is lower than that, and no run tells of it: with a range that ends at 1e7
// there is no such point.
TEST(Box, A_range_past_the_stability_limit_leaves_a_gap_that_is_laid_to_the_step_and_not_to_mu) {
  PlantedBox box;
  box.weights = {{1.0, 0.0}, {0.0, 1.0}};
  box.corners = {{6.0, 0.0}, {0.0, 6.0}};
  box.coarse = 0.0;
  box.cause = [](const std::vector<double>& x) {
    return std::max(x[0], x[1]) > 1e7 ? Cause::diverged : Cause::ok;
  };
  const TuningResult open = tune(box.problem(), box_options(), box.evaluator());
  EXPECT_EQ(open.status, TuningStatus::inconclusive);
  for (const char* part : {"C4: proven gap", "cannot be excluded at this step, whatever mu",
                           "ends as diverged", "end the ranges where runs are stable"}) {
    EXPECT_NE(open.reason.find(part), std::string::npos) << open.reason;
  }
  EXPECT_EQ(open.reason.find("with this mu"), std::string::npos) << open.reason;
  TuningProblem within = box.problem();
  for (TunedVariable& variable : within.variables) variable.high = 1e7;
  const TuningResult closed = tune(within, box_options(), box.evaluator());
  EXPECT_EQ(closed.status, TuningStatus::certified) << closed.reason;
}

TEST(Box, Nothing_that_matches_is_said_with_the_nearest_point) {
  std::mt19937_64 generator(5);
  PlantedBox box = separable(2, generator);
  box.corners[0][0] = 9.0;
  const TuningResult result = tune(box.problem(), box_options(), box.evaluator());
  EXPECT_EQ(result.status, TuningStatus::infeasible);
  EXPECT_NE(result.reason.find("misses by a factor"), std::string::npos) << result.reason;
}

TEST(Box, A_budget_that_ends_first_leaves_the_gap_open_and_says_so) {
  std::mt19937_64 generator(3);
  PlantedBox box = separable(3, generator);
  // A flat trade-off: one component that asks for the sum alone.
  box.weights = {{0.3, 0.3, 0.3}};
  box.corners = {{5.0, 5.0, 5.0}};
  TuningOptions options = box_options();
  options.max_evaluations = 500;
  const TuningResult result = tune(box.problem(), options, box.evaluator());
  EXPECT_EQ(result.status, TuningStatus::inconclusive);
  EXPECT_NE(result.reason.find("C4: proven gap"), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("raise max_evaluations"), std::string::npos) << result.reason;
}

TEST(Proof, Is_no_proof_by_points_that_fail_by_their_step) {
  PlantedBox box;
  box.weights = {{1.0, 0.0}, {0.0, 1.0}};
  box.corners = {{5.0, 0.0}, {0.0, 5.0}};
  box.coarse = 3e4;  // fills the tolerance at 1e8 / sqrt(3e4) = 6e5
  const std::vector<Request> requests = {{{1e5, 1e7}, 1.0, ""}, {{1e5, 1e7}, 0.5, ""}};
  EvaluationLog log(box.problem(), box_options(), box.evaluator());
  log.evaluate(requests);
  const auto points = find_known_points(log.problem().components, log.observations());
  EXPECT_GT(points.at(0).ratio, 1.0);
  EXPECT_LT(points.at(0).net(), 1.0 + 0.02 + 1e-9);
}

TEST(Proof, A_contradiction_doubles_into_mu_and_never_makes_it_smaller) {
  const std::vector<KnownPoint> points = {{{5.0, 5.0}, 0.98, 0.0, 0, false},
                                          {{5.1, 5.0}, 1.04, 0.0, 1, false}};
  const MonotoneAudit audit = audit_monotony(points, true);
  EXPECT_EQ(audit.pairs, 1U);
  EXPECT_EQ(audit.contradictions, 1U);
  EXPECT_NEAR(audit.worst, 0.04, 1e-12);
  EXPECT_NEAR(choose_mu(0.02, audit), 0.08, 1e-12);
  EXPECT_EQ(choose_mu(0.2, audit), 0.2);
}

// b rises above a by 10 %; only its bound keeps that from being a contradiction.
TEST(Proof, A_rise_that_the_step_may_explain_is_a_doubt_until_half_the_step_was_tried) {
  const double none = std::numeric_limits<double>::infinity();
  const KnownPoint a{{5.0, 5.0}, 0.98, 0.0, 0, false};
  const auto doubts = [&](const KnownPoint& b) { return find_doubts({a, b}, 0.02); };
  EXPECT_EQ(doubts({{5.1, 5.0}, 1.1, none, 1, false}), std::vector<std::size_t>{1});
  EXPECT_EQ(doubts({{5.1, 5.0}, 1.1, 0.5, 1, false}), std::vector<std::size_t>{1});
  EXPECT_TRUE(doubts({{5.1, 5.0}, 1.1, none, 1, true}).empty());
  EXPECT_TRUE(doubts({{5.1, 5.0}, 1.1, 0.0, 1, false}).empty());     // a contradiction: counted
  EXPECT_TRUE(doubts({{5.1, 5.0}, 1.009, none, 1, false}).empty());  // within mu / 2
  EXPECT_TRUE(doubts({{5.1, 4.9}, 1.1, none, 1, false}).empty());    // not above a
  EXPECT_TRUE(doubts({{5.1, 5.0}, none, none, 1, false}).empty());   // ended by a cause
}

// Second route: the lowest uncovered point of a fine grid.
TEST(Proof, The_lowest_uncovered_corner_is_that_of_a_grid) {
  std::mt19937_64 generator(2);
  std::uniform_int_distribution<int> cell(1, 9);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Position> proofs;
    for (int i = 0; i < 6; ++i) {
      proofs.push_back({double(cell(generator)), double(cell(generator)), double(cell(generator))});
    }
    double lowest = 100.0;  // cells [i, i + 1) are covered where a proof is above i in all
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < 10; ++b)
        for (int c = 0; c < 10; ++c) {
          const bool is_covered = std::any_of(proofs.begin(), proofs.end(), [&](const Position& p) {
            return p[0] > a && p[1] > b && p[2] > c;
          });
          if (!is_covered) lowest = std::min(lowest, double(a + b + c));
        }
    EXPECT_EQ(find_lowest_uncovered({0, 0, 0}, {10, 10, 10}, proofs, 100.0), lowest) << trial;
  }
}

TEST(Lockstep, Batches_are_those_of_the_searches_in_order_and_each_point_once) {
  std::vector<std::string> batches;
  const EvaluateBatch evaluate = [&](const std::vector<Request>& requests) {
    std::string text;
    std::vector<Answer> answers;
    for (const Request& request : requests) {
      text += std::to_string(int(request.x[0])) + " ";
      answers.push_back({0, Cause::ok, {}, {request.x[0]}});
    }
    batches.push_back(text);
    return answers;
  };
  std::vector<LockstepSearch> searches;
  for (const int rounds : {1, 3, 2}) {
    searches.push_back([rounds](const EvaluateBatch& ask) {
      for (int i = 0; i < rounds; ++i) {
        const double x = 10.0 * rounds + i;
        EXPECT_EQ(ask({{{x}, 1.0, ""}, {{99.0}, 1.0, ""}}).at(0).errors.at(0), x);
      }
    });
  }
  run_in_lockstep(evaluate, searches);
  EXPECT_EQ(batches, (std::vector<std::string>{"10 99 30 20 ", "31 99 21 ", "32 99 "}));
}

TEST(Lockstep, What_an_evaluation_throws_ends_all_and_comes_back) {
  const EvaluateBatch evaluate = [](const std::vector<Request>&) -> std::vector<Answer> {
    throw std::domain_error("stop");
  };
  const LockstepSearch search = [](const EvaluateBatch& ask) { ask({{{1.0}, 1.0, ""}}); };
  EXPECT_THROW(run_in_lockstep(evaluate, {search, search}), std::domain_error);
}

}  // namespace
}  // namespace linkstudy::tuning::box_test
