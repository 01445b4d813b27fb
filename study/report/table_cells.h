// Cells and heads, shared by the forms of a table.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/table.h"

namespace linkstudy {

// The number in the column's form, the text on one line, `missing` for a number that is NaN.
std::string shown(const Column& column, std::size_t row, const std::string& missing);

// What programs read: the number with all digits, null where there is none, the word or the text.
nlohmann::ordered_json json_cell(const Column& column, std::size_t row);

// A column's name over lines of at most `width` characters as far as it can be broken behind dots,
// underscores and blanks.
std::vector<std::string> wrapped(std::string_view name, std::size_t width);

// content(column) for the columns of a table, with `separator` between them.
template <class Content>
std::string joined_columns(const Table& table, std::string_view separator, Content content) {
  std::string text;
  for (const Column& column : table.columns) {
    if (&column != &table.columns.front()) text += separator;
    text += content(column);
  }
  return text;
}

}  // namespace linkstudy
