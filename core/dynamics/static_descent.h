// The way downhill from a pose to an equilibrium that loads have left behind a limit load
// (snap-through): Newton's step on the directions that holds and closures leave free, with the
// stiffness K = V diag(e) V^T replaced by V diag(max(|e|, floor)) V^T, so that every step goes
// along the forces (modified Newton method: Gill, Murray and Wright, Practical Optimization,
// sec. 4.4). Steps are halved while they overshoot a balance along their own direction. Where
// forces have a potential it falls, and the end is no maximum or saddle of it.
#pragma once

#include <vector>

#include "core/model/compile.h"
#include "core/model/workspace.h"

namespace linkstudy {

// The pose at the end, from which Newton's iteration may finish; `start` where it leads nowhere.
State<double> descend_to_rest(const Model& model, const State<double>& start,
                              const std::vector<int>& free, Workspace<double>& w);

}  // namespace linkstudy
