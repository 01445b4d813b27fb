// A flexible link: its beam, with the moments of the section computed from its shape.
#pragma once

#include <optional>

#include "core/topology/linkage.h"
#include "study/config/tree.h"

namespace linkstudy {

// Nothing without the table, or where it says enabled = false. `across` is filled in.
std::optional<FlexibleBeam> read_flexible(Tree& link_table, Diagnostics& diagnostics);

}  // namespace linkstudy
