// Cells as people read them: shared by the text, Markdown and LaTeX forms of a table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/report/table.h"

namespace linkstudy {

// The cell of a row, missing where the row is shorter. Throws std::invalid_argument for a row that
// is longer than the table is wide.
const Cell& cell_of(const Table& table, const std::vector<Cell>& row, std::size_t column);

// The number in the column's form, the text on one line, `missing` for nothing.
std::string shown(const TableColumn& column, const Cell& cell, const std::string& missing);

// content(0), content(1), ... for the columns of a table, with `separator` between them.
template <class Content>
std::string joined_columns(const Table& table, std::string_view separator, Content content) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (i > 0) text += separator;
    text += content(i);
  }
  return text;
}

}  // namespace linkstudy
