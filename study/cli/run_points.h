// A study from its input to its table and digest, for the verbs that are one.
#pragma once

#include "study/cli/command_line.h"
#include "study/session/launch.h"

namespace linkstudy {

// Returns the exit code.
int run_points(const CommandLine& line, const ReadInput& read);

}  // namespace linkstudy
