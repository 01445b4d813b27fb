// Reads tables of numbers: comma-separated, # starts a comment line. Names are the first row that
// is not a number, or else the last comment line before the numbers.
#pragma once

#include <string>
#include <vector>

namespace linkstudy::testing {

struct Csv {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  const std::vector<double>& column(const std::string& name) const;  // throws when there is none
};

Csv read_csv(const std::string& path);  // throws when unreadable or ragged

}  // namespace linkstudy::testing
