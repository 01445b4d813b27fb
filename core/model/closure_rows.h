// Which scalar directions a closure has, as rows of the Mechanism: the one list of what each joint
// type blocks, what a clearance leaves blocked, and what a spring-damping element resists.
#pragma once

#include <vector>

#include "core/model/mechanism.h"

namespace linkstudy {

// Rows held by multipliers but for the directions in `idle`: what the joint type blocks; with
// clearance the axial motion, and the tilts too if planar; of an sde its shut_directions, which is
// what closes when a run begins.
std::vector<Row> make_cut_rows(const Closure& closure, ClosureIndex index, unsigned idle);

// Rows of a spring-damping element, of the directions with stiffness or damping.
std::vector<Row> make_sde_rows(const Closure& closure, ClosureIndex index);

}  // namespace linkstudy
