// What statics and kinematics say of the results that -o keeps.
#pragma once

#include "study/cli/input.h"
#include "study/session/model_results.h"

namespace linkstudy {

struct Kept {
  std::string digest;  // empty without -o
  std::string directory;
};

// Nothing without -o; --fresh is refused then.
Kept keep_if_asked(const CommandLine& line, const ReadModel& model, const std::string& course,
                   ModelResults results);

// "results digest: ...", and the object of --json with digest and results.
std::string digest_line(const Kept& kept);
std::string with_digest(const std::string& json, const Kept& kept);

}  // namespace linkstudy
