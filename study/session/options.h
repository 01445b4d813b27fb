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
  bool fresh = false;                // overwrite what the directory holds
  bool retry_failed = false;         // run failed rows again (continuation.h)
  bool extend = false;               // keep the rows of a study that this one contains
  std::optional<std::string> cache;  // directory of results that studies share
  bool is_part = false;              // of a queue, which has said what runs where
  bool goes_on = false;              // the verb has options that go on with other studies
  std::string progress = "auto";     // a word of ProgressMode
  std::string log_level = "info";    // of linkstudy.log
};

}  // namespace linkstudy
