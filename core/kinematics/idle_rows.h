// Directions of closures that hold by themselves: in a planar linkage nothing tilts a pin and
// nothing moves along it, whatever the joints do. Such a row has no Jacobian at all; its multiplier
// of least norm is zero, so a run may leave it out and keep every number, at the price of a smaller
// and definite system instead of one with dependent rows (reactions that all joints share get it
// back: core/dynamics/shared_reactions.h). Rows that depend on others are not idle.
#pragma once

#include <vector>

#include "core/topology/linkage.h"

namespace linkstudy {

// For every closure a bit mask over Direction. Judged at poses spread over the joints' ranges:
// a row is idle where its displacement and its rates by all velocities vanish at each of them, up
// to rounding. A row that is never closed is not idle.
std::vector<unsigned> find_idle_directions(const Linkage& linkage);

}  // namespace linkstudy
