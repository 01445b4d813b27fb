#include "study/tune/start_nlopt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/tune/lockstep.h"
#include "study/tune/polish_point.h"
#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

// New evaluations of each algorithm from each start, per variable.
constexpr std::size_t kPerVariable = 30;
constexpr double kApart = 0.25;  // decades

struct RankedPoint {
  double violation = 0.0;  // log10 of the ratio, 0 where it matches
  double objective = 0.0;
  std::vector<double> x;
  bool operator<(const RankedPoint& other) const {
    return std::pair(violation, objective) < std::pair(other.violation, other.objective);
  }
};

bool is_near_start(const TuningProblem& problem, const std::vector<double>& a,
                   const std::vector<double>& b) {
  for (std::size_t j = 0; j < a.size(); ++j) {
    if (std::abs(distance(problem.variables[j], a[j], b[j])) > kApart) return false;
  }
  return true;
}

}  // namespace

std::vector<std::vector<double>> choose_starts(const EvaluationLog& log, std::size_t count) {
  std::vector<RankedPoint> ranked;
  for (const Observation& seen : log.observations()) {
    const double ratio = compute_ratio(seen.answer, log.problem().components);
    if (seen.request.step_factor != 1.0 || !std::isfinite(ratio)) continue;
    ranked.push_back({std::max(0.0, std::log10(ratio)), log.objective(seen), seen.request.x});
  }
  std::ranges::stable_sort(ranked, std::less<>());
  std::vector<std::vector<double>> starts;
  for (const RankedPoint& point : ranked) {
    const bool is_new = std::ranges::none_of(
        starts, [&](const auto& other) { return is_near_start(log.problem(), other, point.x); });
    if (is_new) starts.push_back(point.x);
    if (starts.size() == count) break;
  }
  return starts;
}

NloptReport search_from(EvaluationLog& log, const std::vector<std::vector<double>>& starts,
                        double initial_step, std::size_t reserve) {
  NloptReport whole;
  const std::size_t first = log.observations().size();
  const std::size_t available = log.remaining() > reserve ? log.remaining() - reserve : 0;
  if (starts.empty() || available < starts.size()) {
    whole.ended = "skipped: no start, or no evaluations left for it";
    return whole;
  }
  TuningOptions options = log.options();
  options.initial_step = initial_step;
  options.confirm_evaluations = kPerVariable * log.problem().variables.size();
  options.confirm_calls = 4 * options.confirm_evaluations;
  const std::size_t share = available / starts.size();
  std::vector<NloptReport> reports(starts.size());
  std::vector<LockstepSearch> searches;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    searches.push_back([&, i](const EvaluateBatch& ask) {
      TuningOptions own = options;
      own.max_evaluations = share + 1;  // and the start, which is known
      EvaluationLog known(log.problem(), own, ask);
      known.evaluate({{starts[i], 1.0, "nlopt"}});
      reports[i] = confirm_with_nlopt(known, starts[i], 0);
    });
  }
  run_in_lockstep(ask_log(log), searches);
  std::size_t verified = 0;
  for (const NloptReport& one : reports) {
    whole.ran = whole.ran || one.ran;
    whole.calls += one.calls;
    verified += one.verified ? 1 : 0;
    whole.found_lower = whole.found_lower || one.found_lower;
  }
  whole.verified = verified > 0;
  whole.algorithm = "COBYLA, and AUGLAG with BOBYQA where that does not verify";
  whole.ended = fmt::format("{} of {} starts verified", verified, starts.size());
  whole.evaluations = log.observations().size() - first;
  return whole;
}

}  // namespace linkstudy::tuning
