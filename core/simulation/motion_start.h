// Whether prescribed motions fit an assembled start.
#pragma once

#include <string>
#include <vector>

#include "core/model/compile.h"

namespace linkstudy {

// Motions may move what the cut joints leave free and no more; what is wrong, or nothing.
std::string overdriven_text(const Model& model);

// Starts that a motion overrules, and that all freedoms are driven.
std::vector<std::string> motion_warnings(const Linkage& linkage, const Model& model);

}  // namespace linkstudy
