// From arguments to an exit code.
#pragma once

#include <string>
#include <vector>

namespace linkstudy {

int run_program(const std::vector<std::string>& arguments);

}  // namespace linkstudy
