// How a study or tune is run, as the command line says it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace linkstudy {

struct SessionOptions {
  std::string command;                // as typed, for the provenance
  std::optional<std::string> output;  // results directory
  std::vector<std::string> set;       // path=value, in the input already
  std::optional<double> walltime_s;
  bool fresh = false;              // overwrite what the directory holds
  std::string progress = "auto";   // a word of ProgressMode
  std::string log_level = "info";  // of linkstudy.log
};

}  // namespace linkstudy
