// The law of LuGre from the table of a joint or a closure.
#pragma once

#include <optional>

#include "core/topology/linkage.h"
#include "study/config/tree.h"

namespace linkstudy {

// Nothing where the table says enabled = false.
std::optional<Friction> read_friction(const Tree& table);

}  // namespace linkstudy
