// Several variables, or another objective than the lowest value (tune.h has that of one):
//   scan the box; NLopt from the best starts, in lanes and ranks; go down along the axes;
//   the window along every axis; what C0 to C3 need; for two and three variables the proof of C4;
//   and again from any lower match that turned up.
// The point kept is the accepted one of smallest objective among all evaluations.
#pragma once

#include "study/tune/tuning_result.h"

namespace linkstudy::tuning {

TuningResult tune_box(const TuningProblem& problem, const TuningOptions& options,
                      const EvaluateBatch& evaluate);

}  // namespace linkstudy::tuning
