// From the evaluations of a refinement to its answer.
#pragma once

#include <functional>
#include <map>

#include "study/converge/convergence.h"
#include "study/evaluate/evaluator.h"

namespace linkstudy::convergence {

// Time histories of an evaluation in a load case, time first; null where there are none.
using FindHistories = std::function<const std::vector<Trace>*(std::uint64_t evaluation,
                                                              const std::string& load_case)>;

Convergence judge_convergence(const Evaluator& evaluator,
                              const std::map<std::uint64_t, Evaluation>& evaluations,
                              const FindHistories& find_histories);

}  // namespace linkstudy::convergence
