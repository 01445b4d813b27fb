#include "study/tune/tuning_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace linkstudy::tuning {

TuningStatus status_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::certified:
      return TuningStatus::certified;
    case Verdict::refuted:
      return TuningStatus::refuted;
    case Verdict::inconclusive:
      break;
  }
  return TuningStatus::inconclusive;
}

TuningStatus worst_of(const std::vector<TuningResult>& results) {
  TuningStatus worst = TuningStatus::certified;
  const auto weight_of = [](TuningStatus status) {
    constexpr std::array kAscending = {TuningStatus::certified, TuningStatus::inconclusive,
                                       TuningStatus::infeasible, TuningStatus::refuted};
    return std::ranges::find(kAscending, status) - kAscending.begin();
  };
  for (const TuningResult& one : results) {
    if (weight_of(one.status) > weight_of(worst)) worst = one.status;
  }
  return worst;
}

double tolerance_of(const TuningResult& result) {
  return result.problem.components.front().tolerance;
}

double step_of(const TuningResult& result) {
  for (const Observation& seen : result.observations) {
    if (seen.request.step_factor == 1.0) return seen.answer.step;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

const std::string& binding_name(const TuningResult& result) {
  return result.problem.components[result.binding].name;
}

double decades_of(const TunedVariable& variable, const Window& window) {
  return variable.is_logarithmic ? window.margin : std::numeric_limits<double>::quiet_NaN();
}

double shown_objective(const TuningResult& result) {
  if (result.problem.response) {
    return result.problem.response->maximizes ? -result.objective : result.objective;
  }
  const bool is_sum = is_lowest_sum(result.problem) && variable_of(result).is_logarithmic;
  if (is_sum) return result.objective;
  const auto own =
      std::ranges::find_if(result.problem.variables,
                           [](const TunedVariable& variable) { return variable.weight != 0.0; });
  return result.point[static_cast<std::size_t>(own - result.problem.variables.begin())];
}

std::string budget_reason(const EvaluationLog& log) {
  return fmt::format("the budget of {} evaluations is used up: raise max_evaluations",
                     log.budget());
}

void doubt_no_match(const EvaluationLog& log, TuningResult& result) {
  const bool any_transient = std::ranges::any_of(
      log.observations(), [](const Observation& seen) { return is_transient(seen.answer.status); });
  if (!log.exhausted() && !any_transient) return;
  result.status = TuningStatus::inconclusive;
  result.reason = log.exhausted()
                      ? "no match seen, and " + budget_reason(log)
                      : "no match seen, but some evaluations ended by causes of the machine";
}

std::optional<Observation> find_first_failure(const EvaluationLog& log) {
  for (const Observation& seen : log.observations()) {
    const bool is_of_search = seen.request.step_factor <= 1.0;
    if (is_of_search && seen.answer.status != Cause::ok) return seen;
  }
  return std::nullopt;
}

void note_coarse_step(TuningResult& result) {
  if (!(result.answer.h_omega > 1.0)) return;
  result.notes.push_back(
      fmt::format("h omega_max is {:.3g}, above 1: the step resolves the fastest oscillation "
                  "poorly",
                  result.answer.h_omega));
}

}  // namespace linkstudy::tuning
