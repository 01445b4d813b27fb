// The settings of a spring-damping element. One number c means c in the translational directions
// that the closure type blocks and c arm^2 in the rotational ones; in a table, `all` is that number
// and named directions replace it, 0 freeing one and any positive one adding one.
#pragma once

#include "core/topology/linkage.h"
#include "study/config/tree.h"

namespace linkstudy {

void read_sde(Tree& closure_table, Closure& closure, Diagnostics& diagnostics);

}  // namespace linkstudy
