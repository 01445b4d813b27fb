// All problems of an input file, and of the model files it names, in one pass.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

std::vector<Diagnostic> check_file(const std::string& path);

// The same, with what is remarked beside it.
void check_file(const std::string& path, Diagnostics& diagnostics,
                const ReadEarlierRun& earlier = {});

}  // namespace linkstudy
