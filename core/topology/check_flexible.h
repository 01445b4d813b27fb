// Checks of a flexible link: numbers in range, and the link the uniform beam that rigid finite
// elements stand for, with L the distance from begin to end and m the mass:
//   centre of mass in the middle (to 1e-6 L), the beam axis principal (to 1e-6 of the largest
//   moment), every moment across the axis at least m L^2 / 12 (to 1e-8), that of a thin rod.
#pragma once

#include <string>
#include <vector>

#include "core/topology/linkage.h"
#include "core/topology/problem.h"

namespace linkstudy {

// Of a flexible link. Appends to `problems`; `path` addresses the link.
void check_flexible(const Link& link, const std::string& path, std::vector<Problem>& problems);

}  // namespace linkstudy
