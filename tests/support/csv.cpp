#include "tests/support/csv.h"

#include <fmt/core.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace linkstudy::testing {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) {
    const auto from = part.find_first_not_of(" \t\r#");
    const auto to = part.find_last_not_of(" \t\r");
    parts.push_back(from == std::string::npos ? "" : part.substr(from, to - from + 1));
  }
  return parts;
}

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

}  // namespace

const std::vector<double>& Csv::column(const std::string& name) const {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name) return columns.at(k);
  throw std::invalid_argument(fmt::format("csv: no column '{}'", name));
}

Csv read_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("csv: cannot read '{}'", path));
  Csv csv;
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> row = cells(line);
    if (row.empty()) continue;
    if (csv.columns.empty() && (line[0] == '#' || !is_number(row[0]))) {
      csv.names = row;
      continue;
    }
    if (line[0] == '#') continue;
    csv.columns.resize(csv.columns.empty() ? row.size() : csv.columns.size());
    if (row.size() != csv.columns.size()) {
      throw std::runtime_error(fmt::format("csv: ragged row in '{}'", path));
    }
    for (std::size_t k = 0; k < row.size(); ++k) csv.columns[k].push_back(std::stod(row[k]));
  }
  return csv;
}

}  // namespace linkstudy::testing
