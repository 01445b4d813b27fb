// Several variables and other objectives: tune_box.h. Of one, finds the lowest value whose errors
// all match:
//   scan the range; where nothing matches, refine where a window could hide;
//   close on the lowest feasible boundary, move up if half the step says otherwise;
//   close on the upper end of the window; let NLopt look for anything lower;
//   collect what the certificate needs, and start again from any lower point that turned up.
//   try larger steps at the answer (step_reach.h).
// The point kept is the lowest accepted one among all evaluations, never one only computed.
// Where nothing matches the result is infeasible and says which step would open a window.
// Numerical ends are data in the answers; an exception of `evaluate` leaves unchanged.
#pragma once

#include "study/tune/tuning_result.h"

namespace linkstudy::tuning {

// Throws std::invalid_argument naming the first problem that check() finds.
TuningResult tune(const TuningProblem& problem, const TuningOptions& options,
                  const EvaluateBatch& evaluate);

// Several targets side by side (lockstep.h): each takes the way it takes alone, and what one has
// asked is not asked again.
std::vector<TuningResult> tune(const std::vector<TuningTarget>& targets,
                               const TuningOptions& options, const EvaluateBatch& evaluate);

}  // namespace linkstudy::tuning
