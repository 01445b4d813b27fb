// The options of the verbs: each is one row, with the member of the command line that it fills.
// Parsing, --help, the man page and the completion of the shell come from the rows.
#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <string>
#include <vector>

#include "study/cli/command_line.h"

namespace linkstudy {

struct OptionRow {
  const char* name;   // "output,o"
  const char* value;  // "DIR", or empty for a switch
  const char* meaning;
  using Bind = boost::program_options::value_semantic*(CommandLine& line, const char* value);
  std::function<Bind> bind;
  std::vector<std::string> verbs = {};  // of which this row is the one; none: of all others
  std::vector<std::string> words = {};  // all that the value may be

  std::string full_name() const;   // "output"
  std::string short_name() const;  // "o", or empty
};

// The row of an option ("output,o") of a verb.
const OptionRow& find_option(const std::string& name, const std::string& verb);

// Values that no type can refuse: throws UsageError.
void check_values(const CommandLine& line);

}  // namespace linkstudy
