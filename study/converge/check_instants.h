// Whether the levels of a refinement keep instants in common at which [[series]] can be compared.
#pragma once

#include "study/evaluate/evaluator.h"

namespace linkstudy::convergence {

// `points` by id. Reported at the window or the signal of the [[series]].
void check_common_instants(const Evaluator& evaluator, const std::vector<Point>& points,
                           Diagnostics& diagnostics);

}  // namespace linkstudy::convergence
