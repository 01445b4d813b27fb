// The whole check of one input file: what config judges by itself (study/config/check_file.h), and
// what needs the compiled model: names of signals, windows.
#pragma once

#include <string>

#include "study/config/diagnostic.h"

namespace linkstudy {

void check_input(const std::string& path, Diagnostics& diagnostics);

}  // namespace linkstudy
