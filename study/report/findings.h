// What was found out about a model, line by line: the text that people read, and a table of
// results.
#pragma once

#include <string>
#include <vector>

#include "study/record/evaluation.h"
#include "study/record/table.h"

namespace linkstudy {

struct Finding {
  std::string label;  // "mobility"
  std::string text;
};

struct FoundNumber {
  Response response;
  double value = 0.0;  // NaN where there is none
};

// Aligned lines.
std::string text_of(const std::vector<Finding>& findings);

// Columns finding and text.
Table findings_table(const std::vector<Finding>& findings);

}  // namespace linkstudy
