// The checks of a prescribed motion: values and table. Part of check(Linkage).
#pragma once

#include <string>
#include <vector>

#include "core/topology/linkage.h"
#include "core/topology/problem.h"

namespace linkstudy {

void check_motion(const Motion& motion, const std::string& path, std::vector<Problem>& problems);

}  // namespace linkstudy
