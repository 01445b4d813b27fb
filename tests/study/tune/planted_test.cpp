// What the tuner says of problems whose truth is known (planted_problem.h): 760 seeded runs.
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "planted_problem.h"
#include "study/tune/monotone_proof.h"
#include "study/tune/scan_box.h"

namespace linkstudy::tuning::testing::planted_test {
namespace {

TuningOptions options_of(std::size_t n) {
  TuningOptions options;
  options.batch = n == 1 ? 8 : 16;
  options.max_evaluations = n == 1 ? 200 : 800;
  return options;
}

const Claim* claim_of(const TuningResult& result, const std::string& name) {
  if (!result.certificate) return nullptr;
  for (const Claim& claim : result.certificate->claims)
    if (claim.name == name) return &claim;
  return nullptr;
}

bool is_certified(const TuningResult& result, const std::string& name) {
  const Claim* claim = claim_of(result, name);
  return claim != nullptr && claim->verdict == Verdict::certified;
}

// What holds of every answer, whatever was planted. `seen`: where the run came from.
void expect_sound(PlantedProblem& planted, const TuningOptions& options, const TuningResult& result,
                  const std::string& seen) {
  EXPECT_LE(planted.asked, options.max_evaluations) << seen;
  EXPECT_EQ(planted.asked, result.observations.size()) << seen;
  if (result.status == TuningStatus::infeasible) {
    EXPECT_TRUE(result.point.empty()) << seen;
    return;
  }
  if (result.status == TuningStatus::certified) {
    ASSERT_FALSE(result.point.empty()) << seen;
    EXPECT_TRUE(planted.matches(result.point)) << seen;
  }
  if (is_certified(result, "C0")) {
    EXPECT_TRUE(planted.matches(result.point)) << seen;
  }
  if (result.status != TuningStatus::certified) return;
  // C1 and C2 by the problem itself, not by what the tuner has on record.
  for (std::size_t j = 0; j < result.point.size(); ++j) {
    std::vector<double> x = result.point;
    x[j] *= 1.0 - options.delta;
    EXPECT_FALSE(planted.matches(x)) << seen << ", variable " << j;
  }
  for (const std::vector<double>& x : result.certificate->terms.scan) {
    if (compute_objective(x) >= result.objective) continue;
    EXPECT_FALSE(planted.matches(x)) << seen;
  }
  // Nothing that was seen to match lies lower by more than the resolution.
  for (const Observation& one : result.observations) {
    if (compute_objective(one.request.x) > result.objective - 2.0 * options.resolution) continue;
    EXPECT_FALSE(planted.matches(one.request.x)) << seen;
  }
}

// The mu that C4 prints, as a fraction.
double printed_mu(const TuningResult& result) {
  const std::string& text = claim_of(result, "C4")->reason;
  return std::stod(text.substr(text.find("monotone to ") + 12)) / 100.0;
}

// All pairs a <= b of points that were run at the base step: how far the error of b rises above
// that of a matching one, beyond the tolerance. Of problems without what the step adds.
double worst_rise(const TuningResult& result) {
  double worst = 0.0;
  for (const Observation& a : result.observations) {
    if (a.request.step_factor != 1.0) continue;
    const double ra = compute_ratio(a.answer, result.problem.components);
    if (!(ra <= 1.0)) continue;
    for (const Observation& b : result.observations) {
      const double rb = compute_ratio(b.answer, result.problem.components);
      if (b.request.step_factor != 1.0 || !std::isfinite(rb)) continue;
      bool is_above = true;
      for (std::size_t j = 0; j < a.request.x.size(); ++j) {
        is_above = is_above && b.request.x[j] >= a.request.x[j];
      }
      if (is_above) worst = std::max(worst, rb - 1.0);
    }
  }
  return worst;
}

struct Tally {
  int runs = 0, found = 0, certified = 0, close = 0;
};

TuningResult tune_planted(PlantedProblem& planted, const TuningOptions& options,
                          const std::string& seen) {
  TuningResult result = tune(planted.problem(), options, planted.evaluator());
  expect_sound(planted, options, result, seen);
  return result;
}

// Steep and flat trade-offs over one to three variables and up to five components; the window ends
// by accuracy or by stability. 0.02 decade: the distance that is wanted.
TEST(Planted, Smooth_optima_are_found_within_a_fiftieth_of_a_decade) {
  std::mt19937_64 random(101);
  const std::map<std::size_t, int> counts = {{1, 120}, {2, 90}, {3, 40}};
  for (const auto& [n, count] : counts) {
    Tally tally;
    for (int i = 0; i < count; ++i) {
      PlantedProblem planted = plant(n, random);
      const std::string seen = fmt::format("{} variables, run {}", n, i);
      const TuningResult result = tune_planted(planted, options_of(n), seen);
      ++tally.runs;
      ASSERT_FALSE(result.point.empty()) << seen << ": " << result.reason;
      EXPECT_TRUE(planted.matches(result.point)) << seen;
      EXPECT_GE(result.objective, planted.least_objective() - 1e-9) << seen;
      const double above = result.objective - planted.attained_objective();
      tally.close += above <= 0.02 ? 1 : 0;
      tally.certified += result.status == TuningStatus::certified ? 1 : 0;
    }
    RecordProperty(fmt::format("certified_{}", n), tally.certified);
    EXPECT_GE(tally.close, 0.95 * tally.runs) << n << " variables";
  }
}

// Up to 20 % of the tolerance, in waves from wide to as narrow as what the tuner tells apart.
TEST(Planted, Ripple_never_makes_an_answer_that_does_not_match) {
  std::mt19937_64 random(102);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 120; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(i % 3);
    PlantedProblem planted = plant(n, random);
    const double amplitude = std::log10(1.0 + 0.2 * unit(random));
    const double wave = std::pow(10.0, 0.5 + 2.5 * unit(random));
    planted.disturbance = [=](const std::vector<double>& x, double) {
      double phase = 0.0;
      for (std::size_t j = 0; j < x.size(); ++j) {
        phase += wave * (1.0 + 0.3 * static_cast<double>(j)) * std::log10(x[j]);
      }
      return amplitude * std::sin(phase);
    };
    const std::string seen = fmt::format("run {}", i);
    const TuningResult result = tune_planted(planted, options_of(n), seen);
    ASSERT_FALSE(result.point.empty()) << seen << ": " << result.reason;
    EXPECT_TRUE(planted.matches(result.point)) << seen << ": " << result.reason;
  }
}

// A resonance that makes the error dip below the boundary, in a band along the first axis (its
// width from a hundredth of a decade to one): where the declared scan sees the dip, no answer above
// it is certified.
TEST(Planted, Nothing_is_certified_above_a_match_that_the_declared_scan_can_see) {
  std::mt19937_64 random(103);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int visible = 0;
  for (int i = 0; i < 90; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(i % 2);
    PlantedProblem planted = plant(n, random);
    const double middle = std::log10(planted.optimum[0]) - 0.2 - 0.6 * unit(random);
    const double half = 0.5 * std::pow(10.0, -2.0 * unit(random));
    planted.disturbance = [=](const std::vector<double>& x, double) {
      return std::abs(std::log10(x[0]) - middle) < half ? -1.5 : 0.0;
    };
    const std::string seen = fmt::format("run {}", i);
    const TuningResult result = tune_planted(planted, options_of(n), seen);
    ASSERT_FALSE(result.point.empty()) << seen << ": " << result.reason;
    EXPECT_TRUE(planted.matches(result.point)) << seen;
    const bool is_below = result.objective < planted.least_objective() - 0.1;
    visible += is_below ? 1 : 0;
  }
  EXPECT_GE(visible, 20);
}

// Parts of the range that end by a cause, give NaN, or fail by chance as machines do.
TEST(Planted, Failing_regions_end_no_search_and_prove_nothing) {
  std::mt19937_64 random(104);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::vector<Cause> causes = {Cause::statics_failed, Cause::diverged, Cause::timeout,
                                     Cause::exception, Cause::ok};
  for (int i = 0; i < 100; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(i % 3);
    PlantedProblem planted = plant(n, random);
    const Cause cause = causes[static_cast<std::size_t>(i) % causes.size()];
    const double edge = std::log10(planted.optimum[0]) + (unit(random) < 0.5 ? -0.3 : 0.6);
    const double chance = 0.1 * unit(random);
    const bool is_below = edge < std::log10(planted.optimum[0]);
    const auto is_in = [=](const std::vector<double>& x) {
      const double t = std::log10(x[0]);
      return is_below ? t < edge : t > edge && t < edge + 0.2;
    };
    planted.cause = [=](const std::vector<double>& x, double h) {
      const std::size_t mixed = std::hash<double>{}(x[0] + h);
      const bool by_chance = is_transient(cause) &&
                             static_cast<double>(std::mt19937_64(mixed)() % 1000) < 1000.0 * chance;
      return is_in(x) || by_chance ? cause : Cause::ok;
    };
    if (cause == Cause::ok) {
      planted.disturbance = [=](const std::vector<double>& x, double) {
        return is_in(x) ? std::numeric_limits<double>::quiet_NaN() : 0.0;
      };
    }
    const std::string seen = fmt::format("run {}, {}", i, name_of(cause));
    const TuningResult result = tune_planted(planted, options_of(n), seen);
    ASSERT_FALSE(result.point.empty()) << seen << ": " << result.reason;
    if (!is_transient(cause)) {
      EXPECT_TRUE(planted.matches(result.point)) << seen << ": " << result.reason;
      EXPECT_LE(result.objective, planted.attained_objective() + 0.1) << seen;
    }
    if (result.status != TuningStatus::certified) continue;
    // No claim but the audit rests on a run that may end otherwise.
    for (const Claim& claim : result.certificate->claims) {
      if (claim.name == "C4" || claim.name == "C3") continue;
      for (const std::uint64_t id : claim.evaluations) {
        const Observation& other = result.observations.at(id);
        const Acceptance both =
            judge_acceptance(&other, &other, result.problem.components);  // of this one alone
        const bool is_rejected_otherwise =
            std::ranges::any_of(result.observations, [&](const Observation& one) {
              return one.request.x == other.request.x &&
                     judge_acceptance(&one, &one, result.problem.components) ==
                         Acceptance::rejected;
            });
        EXPECT_TRUE(both != Acceptance::open || is_rejected_otherwise)
            << seen << ": " << claim.name << " rests on evaluation " << id;
      }
    }
  }
}

TEST(Planted, Where_nothing_matches_no_answer_is_given) {
  std::mt19937_64 random(105);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const std::size_t n = 1 + static_cast<std::size_t>(i % 3);
    PlantedProblem planted = plant(n, random);
    if (i % 2 == 0) {
      planted.disturbance = [](const auto&, double) { return 4.0; };  // too soft up to the end
      planted.ceiling = 1e12;
    } else {
      planted.ceiling = *std::ranges::max_element(planted.optimum) * (0.2 + 0.5 * unit(random));
    }
    const std::string seen = fmt::format("run {}", i);
    const TuningResult result = tune_planted(planted, options_of(n), seen);
    const bool is_none =
        result.status == TuningStatus::infeasible || result.status == TuningStatus::inconclusive;
    EXPECT_TRUE(is_none && result.point.empty()) << seen << ": " << result.reason;
  }
}

// A band in which the error rises above that of softer points, by 0 to 100 % of the tolerance.
TEST(Planted, A_breach_of_monotony_beyond_the_printed_mu_closes_no_gap) {
  std::mt19937_64 random(106);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int breached = 0;
  int closed = 0;
  for (int i = 0; i < 80; ++i) {
    const std::size_t n = 2 + static_cast<std::size_t>(i % 4 == 3);
    PlantedProblem planted = plant(n, random);
    planted.ceiling = 1e14;  // no part of the step
    planted.limit = std::numeric_limits<double>::infinity();
    const double rise = std::log10(1.0 + unit(random) * unit(random));
    const double wave = 4.0 + 40.0 * unit(random);
    planted.disturbance = [=](const std::vector<double>& x, double) {
      return rise * std::sin(wave * std::log10(x[0])) * std::cos(0.7 * wave * std::log10(x[1]));
    };
    TuningOptions options = options_of(n);
    options.gap = 0.1 + 0.3 * unit(random);
    const std::string seen = fmt::format("run {}", i);
    const TuningResult result = tune_planted(planted, options, seen);
    ASSERT_FALSE(result.point.empty()) << seen << ": " << result.reason;
    const double worst = worst_rise(result);
    breached += worst > 0.02 ? 1 : 0;
    if (!is_certified(result, "C4")) continue;
    ++closed;
    // Printed to three digits.
    EXPECT_LE(worst, printed_mu(result) * 1.005 + 1e-9) << seen << claim_of(result, "C4")->reason;
    for (const Observation& one : result.observations) {
      if (compute_objective(one.request.x) > result.objective - options.gap - 0.002) continue;
      EXPECT_FALSE(planted.matches(one.request.x)) << seen;
    }
  }
  EXPECT_GE(breached, 20);
  EXPECT_GE(closed, 10);
}

// A pocket that matches, far below the answer: where a run has seen it, it is the answer or the
// verdict is open; where the proof's own points lie in or above it, C4 does not close over it.
TEST(Planted, A_pocket_below_a_failing_point_is_not_proven_away_once_it_is_seen) {
  std::mt19937_64 random(107);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int seen_pockets = 0;
  for (int i = 0; i < 60; ++i) {
    PlantedProblem planted = plant(2, random);
    const double depth = 0.2 + 0.6 * unit(random);
    const double radius = 0.05 + 0.6 * unit(random);
    const std::vector<double> at = {std::log10(planted.optimum[0]) - depth,
                                    std::log10(planted.optimum[1]) - 0.3 * depth};
    planted.disturbance = [=](const std::vector<double>& x, double) {
      const double distance = std::hypot(std::log10(x[0]) - at[0], std::log10(x[1]) - at[1]);
      return distance < radius ? -2.0 : 0.0;
    };
    const std::string seen = fmt::format("run {}", i);
    const TuningResult result = tune_planted(planted, options_of(2), seen);
    ASSERT_FALSE(result.point.empty()) << seen << ": " << result.reason;
    EXPECT_TRUE(planted.matches(result.point)) << seen;
    bool has_seen = false;
    for (const Observation& one : result.observations) {
      has_seen = has_seen || (planted.disturbance(one.request.x, 0.0) < 0.0);
    }
    seen_pockets += has_seen ? 1 : 0;
  }
  EXPECT_GE(seen_pockets, 20);
}

// A region of two hundredths of the box that matches, between the points of the scan: with a slope
// that leads there from afar, and in a plain that leads elsewhere.
TEST(Planted, Scouts_find_a_small_region_that_the_scan_misses) {
  std::mt19937_64 random(109);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr double kBox = 5.0;  // decades along an axis
  for (const bool is_plain : {false, true}) {
    int runs = 0;
    int found = 0;
    for (int i = 0; i < 40; ++i) {
      const std::size_t n = 2 + static_cast<std::size_t>(i % 2);
      PlantedProblem planted = plant(n, random);
      planted.limit = std::numeric_limits<double>::infinity();
      planted.ceiling = 1e14;
      const double unit_ball = n == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
      const auto power = static_cast<double>(n);
      const double radius = std::pow(0.02 * std::pow(kBox, power) / unit_ball, 1.0 / power);
      std::vector<double> at(n);
      for (double& one : at) one = 3.0 + radius + (kBox - 2.0 * radius) * unit(random);
      const auto distance = [=](const std::vector<double>& x) {
        double square = 0.0;
        for (std::size_t j = 0; j < n; ++j) square += std::pow(std::log10(x[j]) - at[j], 2.0);
        return std::sqrt(square);
      };
      // The errors of plant() are divided out: all components have the ratio `shape`.
      planted.weights = {std::vector<double>(n, 0.0)};
      planted.weights[0][0] = 1.0;
      planted.disturbance = [=, first = planted.optimum[0]](const std::vector<double>& x, double) {
        const double outside = distance(x) - radius;
        const double shape = outside <= 0.0 ? -0.3
                             : is_plain     ? 0.5 - 0.02 * std::log10(x[0])
                                            : 0.1 + 0.3 * outside;
        return shape - std::log10(first / x[0]);
      };
      const auto scan = make_box_scan(planted.problem(), options_of(n).scan);
      const bool is_hit =
          std::ranges::any_of(scan, [&](const auto& x) { return planted.matches(x); });
      if (is_hit) continue;
      TuningOptions options = options_of(n);
      options.max_evaluations = 1200;
      const TuningResult result =
          tune_planted(planted, options, fmt::format("{} run {}", is_plain ? "plain" : "slope", i));
      ++runs;
      if (runs == 1) {  // threads decide nothing
        PlantedProblem again = planted;
        again.asked = 0;
        const TuningResult same = tune(again.problem(), options, again.evaluator());
        ASSERT_EQ(same.observations.size(), result.observations.size());
        for (std::size_t k = 0; k < same.observations.size(); ++k) {
          ASSERT_EQ(same.observations[k].request.x, result.observations[k].request.x) << k;
        }
      }
      found += result.point.empty() ? 0 : 1;
    }
    EXPECT_GE(runs, 15);
    EXPECT_GE(found, (is_plain ? 0.9 : 0.99) * runs) << (is_plain ? "plain" : "slope");
  }
}

// An exception of the evaluations at any time comes back as it is: no thread of NLopt hangs on it.
TEST(Planted, What_an_evaluation_throws_comes_back_whenever_it_does) {
  std::mt19937_64 random(108);
  for (std::size_t n = 1; n <= 3; ++n) {
    for (std::size_t at = 1; at < 300; at = 2 * at + 1) {
      PlantedProblem planted = plant(n, random);
      const EvaluateBatch evaluate = planted.evaluator();
      const EvaluateBatch throwing = [&](const std::vector<Request>& requests) {
        if (planted.asked + requests.size() > at) throw std::domain_error("stop");
        return evaluate(requests);
      };
      try {
        const TuningResult result = tune(planted.problem(), options_of(n), throwing);
        EXPECT_LT(result.observations.size(), at);
      } catch (const std::domain_error&) {
        SUCCEED();
      }
    }
  }
}

}  // namespace
}  // namespace linkstudy::tuning::testing::planted_test
