// Checks of a spring between two points: numbers finite and not negative, a length without force
// where stiffness or one-sided damping ask for one, and a table that acts on the side it may. Part
// of check(Linkage).
#pragma once

#include "core/topology/linkage.h"
#include "core/topology/problem.h"

namespace linkstudy {

void check_point_spring(const PointSpring& spring, const std::string& path,
                        std::vector<Problem>& problems);

}  // namespace linkstudy
