// All problems of an input file, and of the model files it names, in one pass.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

std::vector<Diagnostic> check_file(const std::string& path);

}  // namespace linkstudy
