// A convergence study as one JSON object, on one line: keys as fixed for `converge --json`, NaN as
// null.
#pragma once

#include <string>

#include "study/converge/convergence.h"

namespace linkstudy::convergence {

std::string write_json(const Convergence& result, const std::string& digest);

}  // namespace linkstudy::convergence
