// Searches that ask one after the other, side by side: each runs in a thread of its own until it
// asks; when all of them wait or have ended, what they ask goes out as one batch, in the order of
// the searches and each point once, and the answers go back. So the path of every search, and the
// order of evaluations, depend on the answers alone and never on the threads.
//
// `evaluate` is called by the calling thread only. What it throws ends all searches and is thrown
// again from here; so is what a search throws, of several the first in order.
#pragma once

#include "study/tune/tuning_problem.h"

namespace linkstudy::tuning {

using LockstepSearch = std::function<void(const EvaluateBatch& ask)>;

void run_in_lockstep(const EvaluateBatch& evaluate, const std::vector<LockstepSearch>& searches);

}  // namespace linkstudy::tuning
