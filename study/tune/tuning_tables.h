// A tuning result as named columns, for the results store.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "study/tune/tuning_result.h"

namespace linkstudy::tuning {

// Names are [A-Za-z][A-Za-z0-9_]*; all columns of a table have the same length.
struct Column {
  std::string name;
  std::string unit;
  std::variant<std::vector<double>, std::vector<std::string>> values;
};

struct Table {
  std::string name;
  std::vector<Column> columns;
};

// "result" (one row), "components", "scan" (every value tried at the base step), "certificate"
// (one row a claim, ids separated by blanks), "evaluations" (every one, in the order asked).
std::vector<Table> make_tables(const TuningResult& result);

}  // namespace linkstudy::tuning
