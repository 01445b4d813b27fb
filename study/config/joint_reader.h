// A joint of the tree: frames, start, spring and friction. Arrays over the coordinates get units by
// the joint's type, and zeros where they are not written.
#pragma once

#include "core/topology/linkage.h"
#include "study/config/tree.h"

namespace linkstudy {

Joint read_joint(Tree& joint_table, Diagnostics& diagnostics);

}  // namespace linkstudy
