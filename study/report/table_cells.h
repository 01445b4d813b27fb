// Cells as people read them: shared by the text, Markdown and LaTeX forms of a table.
#pragma once

#include <string>
#include <vector>

#include "study/report/table.h"

namespace linkstudy {

// The cell of a row, missing where the row is shorter. Throws std::invalid_argument for a row that
// is longer than the table is wide.
const Cell& cell_of(const Table& table, const std::vector<Cell>& row, std::size_t column);

// The number in the column's form, the text on one line, `missing` for nothing.
std::string shown(const TableColumn& column, const Cell& cell, const std::string& missing);

}  // namespace linkstudy
