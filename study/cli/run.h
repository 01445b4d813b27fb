// From arguments to an exit code.
#pragma once

#include <string>
#include <vector>

namespace linkstudy {

int run_program(const std::vector<std::string>& arguments);

// Whether the verb is one that a stop signal ends in order (study/schedule/stop_signals.h).
bool is_resumable(const std::vector<std::string>& arguments);

}  // namespace linkstudy
