#include <fmt/format.h>

#include "study/report/table_cells.h"

namespace linkstudy {
namespace {

// What would end a cell or begin markup in it.
std::string escaped(std::string_view text) {
  std::string safe;
  for (char c : text) {
    if (std::string_view("|\\`*_<").find(c) != std::string_view::npos) {
      safe += '\\';
    }
    safe += c;
  }
  return safe;
}

}  // namespace

std::string markdown_of(const Table& table) {
  std::string text = table.title.empty() ? "" : fmt::format("**{}**\n\n", escaped(table.title));
  std::string rule = "|";
  text += "|";
  for (const TableColumn& column : table.columns) {
    const std::string unit = column.unit.empty() ? "" : fmt::format(" [{}]", column.unit);
    text += fmt::format(" {} |", escaped(column.name + unit));
    rule += column.align == Align::right ? " ---: |" : " :--- |";
  }
  text += "\n" + rule + "\n";
  for (const std::vector<Cell>& row : table.rows) {
    text += "|";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      text += fmt::format(" {} |", escaped(shown(table.columns[i], cell_of(table, row, i), "")));
    }
    text += "\n";
  }
  return text;
}

}  // namespace linkstudy
