#include "study/report/table_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace linkstudy {

const Cell& cell_of(const Table& table, const std::vector<Cell>& row, std::size_t column) {
  static const Cell missing;
  if (row.size() > table.columns.size()) {
    throw std::invalid_argument(fmt::format("table '{}': a row has {} cells, there are {} columns",
                                            table.title, row.size(), table.columns.size()));
  }
  return column < row.size() ? row[column] : missing;
}

std::string shown(const TableColumn& column, const Cell& cell, const std::string& missing) {
  if (const double* number = std::get_if<double>(&cell)) {
    return fmt::format(fmt::runtime(column.format), *number);
  }
  if (const std::string* text = std::get_if<std::string>(&cell)) {
    std::string line = *text;
    std::ranges::replace_if(
        line, [](unsigned char c) { return c < ' '; }, ' ');
    return line;
  }
  return missing;
}

}  // namespace linkstudy
