#include "study/tune/tuning_result.h"

#include <fmt/format.h>

#include <algorithm>

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

std::string budget_reason(const EvaluationLog& log) {
  return fmt::format("the budget of {} evaluations is used up: raise max_evaluations",
                     log.options().max_evaluations);
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
    if (seen.answer.status != Cause::ok) return seen;
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
