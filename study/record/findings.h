// What was found out about a model, line by line: the text that people read, and a table of
// results.
#pragma once

#include <string>
#include <string_view>
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

// "LABEL   VALUE\n", aligned; what does not fit the page goes on below the value.
std::string summary_line(std::string_view label, std::string_view value);

// A line each.
std::string text_of(const std::vector<Finding>& findings);

// Columns finding and text.
Table findings_table(const std::vector<Finding>& findings);

}  // namespace linkstudy
