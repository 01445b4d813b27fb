// Clearance, contact and friction of a closure. They are read whatever the model, so that one word
// switches it; model = "clearance" needs the table `clearance`.
#pragma once

#include "core/topology/linkage.h"
#include "study/config/tree.h"

namespace linkstudy {

void read_clearance(Tree& closure_table, Closure& closure, Diagnostics& diagnostics);

}  // namespace linkstudy
