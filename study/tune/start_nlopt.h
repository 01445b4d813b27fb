// NLopt from several starts, side by side (lockstep.h): COBYLA, and where its answer does not
// verify AUGLAG with BOBYQA (confirm_nlopt.h). What it saw is in the log; nothing else of it
// counts.
#pragma once

#include "study/tune/confirm_nlopt.h"

namespace linkstudy::tuning {

// Starts: the points of smallest objective that match, no two within a quarter of a decade, then
// those that miss by least.
std::vector<std::vector<double>> choose_starts(const EvaluationLog& log, std::size_t count);

NloptReport search_from(EvaluationLog& log, const std::vector<std::vector<double>>& starts,
                        double initial_step, std::size_t reserve);

}  // namespace linkstudy::tuning
