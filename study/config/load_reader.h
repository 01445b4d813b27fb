// One load of a model. `torque` and `force` are drives on a joint coordinate, told apart by what
// the coordinate is; the units of values and speeds must fit it.
#pragma once

#include "core/topology/linkage.h"
#include "study/config/tree.h"

namespace linkstudy {

Load read_load(Tree& load_table, const Tree& model, Diagnostics& diagnostics);

}  // namespace linkstudy
