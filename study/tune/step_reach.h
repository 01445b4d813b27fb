// How much larger the step may be for the answer: the run of the point at multiples of its step.
// The reach by accuracy is the largest multiple that matches with all smaller ones tried; the limit
// of stability stands beside it (Answer::step_limit). Multiples are doubled until one fails, then
// halved between.
#pragma once

#include <optional>

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

struct StepReach {
  double step = 0.0;      // s, the largest that matches
  double fails_at = 0.0;  // s, the next one tried; 0 where all match
  double ratio = 0.0;     // there, of error over tolerance; infinite where the run ended by a cause
  Cause cause = Cause::ok;
  std::uint64_t evaluation = 0;  // of the next one
};

// Nothing without multiples (TuningOptions) or evaluations left for them.
std::optional<StepReach> find_step_reach(EvaluationLog& log, const std::vector<double>& point);

}  // namespace linkstudy::tuning
