#include "study/tune/tune.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "study/tune/find_window.h"
#include "study/tune/lockstep.h"
#include "study/tune/polish_point.h"
#include "study/tune/step_reach.h"
#include "study/tune/tune_box.h"

namespace linkstudy::tuning {
namespace {

// Starts from a lower point that turned up late; each is lower by over the resolution, and a noisy
// error function could go on for long.
constexpr int kMostPasses = 4;
// Evaluations NLopt leaves for the certificate.
constexpr std::size_t kCertificateReserve = 6;

void require_valid(const TuningProblem& problem, const TuningOptions& options) {
  const std::vector<Problem> problems = check(problem, options);
  if (!problems.empty()) {
    throw std::invalid_argument(fmt::format("{}: {}; {}", problems.front().path,
                                            problems.front().message, problems.front().remedy));
  }
}

void scan(EvaluationLog& log) {
  std::vector<Request> requests;
  for (const double value : make_scan_values(log.problem().variables.front(), log.options().scan)) {
    requests.push_back({{value}, 1.0, "scan"});
  }
  log.evaluate(requests);
}

// The point that misses by least, whose component and load case say what to look at.
void describe_nearest(const EvaluationLog& log, TuningResult& result) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const double value : log.base_values()) {
    const double ratio = log.ratio(value, 1.0).value();
    if (ratio >= smallest) continue;
    smallest = ratio;
    result.answer = log.find({value}, 1.0)->answer;
    result.answer_value = value;
    result.binding = find_binding(result.answer, log.problem().components);
  }
}

std::string nearest_text(const TuningResult& result) {
  if (result.answer.errors.empty()) {
    return {};
  }
  const MatchComponent& component = result.problem.components[result.binding];
  return fmt::format("; nearest is {:.4g} {}, where {} misses by a factor of {:.3g}",
                     result.answer_value, result.problem.variables.front().unit, component.name,
                     result.answer.errors[result.binding] / component.tolerance);
}

void describe_empty_window(EvaluationLog& log, TuningResult& result) {
  if (!log.exhausted()) probe_half_step(log);
  if (log.base_values().empty()) {
    result.reason = budget_reason(log);
    return;
  }
  result.status = TuningStatus::infeasible;
  describe_nearest(log, result);
  result.reason = "no point of the range matches" + nearest_text(result);
  // What it takes for granted holds of stiffness, which has no linear range.
  if (result.problem.variables.front().is_logarithmic) {
    result.suggestion = suggest_step(log);
    result.reason += ": " + result.suggestion->message;
  }
  doubt_no_match(log, result);
}

// Half the step at the lowest point that beats the one in hand at the base step.
void probe_lower_candidate(EvaluationLog& log, double value) {
  const std::optional<double> candidate = find_lowest_candidate(log);
  if (candidate && *candidate < value) {
    log.evaluate({{{*candidate}, 0.5, "half_step"}});
  }
}

struct Search {
  double value = 0.0;
  Window window;
  CertificateTerms terms;
};

CertificateTerms terms_at(const EvaluationLog& log, double value, const Window& window) {
  std::vector<std::vector<double>> scan;
  for (const double one : make_scan_values(log.problem().variables.front(), log.options().scan)) {
    scan.push_back({one});
  }
  return make_terms(log, {value}, {window.margin}, scan);
}

void gather_evidence(EvaluationLog& log, Search& search) {
  search.terms = terms_at(log, search.value, search.window);
  log.evaluate(list_requests(search.terms, log));
  log.evaluate(list_requests(search.terms, log));  // half steps of what the first round showed
}

Search search_window(EvaluationLog& log, NloptReport& nlopt) {
  Search search;
  search.value = find_lowest_candidate(log).value();
  for (int pass = 0; pass < kMostPasses; ++pass) {
    search.value = descend(log, search.value);
    search.window = find_window(log, search.value);
    if (pass == 0) {
      nlopt = confirm_with_nlopt(log, {search.value}, kCertificateReserve);
      probe_lower_candidate(log, search.value);
    }
    gather_evidence(log, search);
    const double lowest = find_lowest_accepted(log).value_or(search.value);
    if (lowest >= search.value) break;
    search.value = lowest;
  }
  return search;
}

bool has_gap(const std::vector<ScanPoint>& points) {
  int entries = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool starts = i == 0 || points[i - 1].side != Side::feasible;
    entries += points[i].side == Side::feasible && starts ? 1 : 0;
  }
  return entries > 1;
}

void add_notes(const TuningOptions& options, TuningResult& result) {
  const Window& window = *result.window;
  if (window.low_open) {
    result.notes.push_back(fmt::format(
        "the lowest value tried, {:.6g}, already matches: lower the range to find the boundary",
        window.low));
  }
  if (has_gap(result.points)) {
    result.notes.push_back("the matching values do not form one interval: noise or a resonance");
  }
  note_coarse_step(result);
  if (window.margin < 10.0 * options.resolution) {
    result.notes.push_back("the window is hardly wider than the resolution: use a smaller step");
  }
  if (result.nlopt.found_lower) {
    result.notes.push_back(
        fmt::format("NLopt saw a match at {:.6g}, below the section search", result.nlopt.lowest));
  }
}

// The point in hand is the lowest accepted, or else the lowest that matches at the base step.
void describe_window(EvaluationLog& log, Search search, TuningResult& result) {
  const double value = find_lowest_accepted(log).value_or(search.value);
  search.window = find_window(log, value);  // with everything NLopt and the claims have seen
  if (value != search.value) search.terms = terms_at(log, value, search.window);
  result.point = {value};
  result.objective = search.terms.objective;
  result.answer = log.find(result.point, 1.0)->answer;
  result.answer_value = value;
  result.binding = find_binding(result.answer, log.problem().components);
  result.window = search.window;
  result.certificate = make_certificate(search.terms, log);
  result.status = status_of(result.certificate->verdict);
  result.reason = result.certificate->reason;
  if (log.exhausted() && result.status != TuningStatus::refuted) {
    result.status = TuningStatus::inconclusive;
    result.reason = budget_reason(log);
  }
}

}  // namespace

TuningResult tune(const TuningProblem& problem, const TuningOptions& options,
                  const EvaluateBatch& evaluate) {
  require_valid(problem, options);
  const bool is_lowest_of_one = problem.variables.size() == 1 && is_lowest_sum(problem);
  if (!is_lowest_of_one) return tune_box(problem, options, evaluate);
  EvaluationLog log(problem, options, evaluate);
  TuningResult result;
  result.problem = problem;
  scan(log);
  if (refine_scan(log)) {
    const Search search = search_window(log, result.nlopt);
    describe_window(log, search, result);
  } else {
    describe_empty_window(log, result);
  }
  result.points = classify_points(log);
  if (!result.point.empty()) result.step_reach = find_step_reach(log, result.point);
  result.observations = log.observations();
  result.first_failure = find_first_failure(log);
  result.rounds = log.rounds();
  if (result.window) add_notes(options, result);
  return result;
}

std::vector<TuningResult> tune(const std::vector<TuningTarget>& targets,
                               const TuningOptions& options, const EvaluateBatch& evaluate) {
  if (targets.size() == 1 && targets.front().step_factor == 1.0) {
    return {tune(targets.front().problem, options, evaluate)};
  }
  TuningOptions of_all = options;
  const std::size_t own = EvaluationLog(targets.front().problem, options, evaluate).budget();
  of_all.max_evaluations = targets.size() * own;
  of_all.batch = *of_all.max_evaluations;  // what all ask in a round is one
  EvaluationLog known(targets.front().problem, of_all, evaluate);
  std::vector<TuningResult> results(targets.size());
  std::vector<LockstepSearch> searches;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    searches.push_back([&, i](const EvaluateBatch& ask) {
      const auto at_own_step = [&](std::vector<Request> requests) {
        for (Request& request : requests) request.step_factor *= targets[i].step_factor;
        return ask(requests);
      };
      results[i] = tune(targets[i].problem, options, at_own_step);
    });
  }
  run_in_lockstep(ask_log(known), searches);
  return results;
}

}  // namespace linkstudy::tuning
