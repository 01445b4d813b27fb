// From the evaluations of a design of blocks to sensitivities: of every component of [[match]] (the
// error by its own norm) and of [[response]], in every load case. A block counts for a quantity
// when all of its evaluations ended ok with that number. Differences below 1e-12 of the greatest
// value are rounding and count as none.
#pragma once

#include <map>

#include "study/config/study_input.h"
#include "study/sensitivity/sensitivity.h"

namespace linkstudy::sensitivity {

// `responses`: of every evaluation, by position. Same evaluations, same answer to the last bit.
Sensitivity judge_sensitivity(const StudyInput& input, const std::vector<Response>& responses,
                              const std::map<std::uint64_t, Evaluation>& evaluations);

}  // namespace linkstudy::sensitivity
