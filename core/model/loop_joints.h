// Joints that can bear against each other: those of one loop, and of loops that have joints in
// common. Seen as a graph of links and joints these are the blocks (two-connected components) with
// more than one joint, whichever joint of a loop is cut. Joints that let everything go (free) and
// replacement joints, whose forces are known, make no loop.
#pragma once

#include "core/model/mechanism.h"

namespace linkstudy {

// Fills loop_joints and loop_rows of the mechanism compiled from a linkage.
void add_loop_joints(const Linkage& linkage, Mechanism& m);

}  // namespace linkstudy
