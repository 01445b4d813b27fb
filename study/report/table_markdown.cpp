#include <fmt/format.h>

#include "study/report/table_cells.h"
#include "study/report/write_table.h"

namespace linkstudy {
namespace {

// What would end a cell or begin markup in it.
std::string markdown_escaped(std::string_view text) {
  std::string safe;
  for (char c : text) {
    if (std::string_view("|\\`*_<").find(c) != std::string_view::npos) safe += '\\';
    safe += c;
  }
  return safe;
}

}  // namespace

std::string markdown_of(const Table& table) {
  std::string text =
      table.name.empty() ? "" : fmt::format("**{}**\n\n", markdown_escaped(table.name));
  std::string rule = "|";
  text += "|";
  const std::size_t rows = row_count(table);
  for (const Column& column : table.columns) {
    const std::string unit = column.unit.empty() ? "" : fmt::format(" [{}]", column.unit);
    text += fmt::format(" {} |", markdown_escaped(column.name + unit));
    rule += is_number(column) ? " ---: |" : " :--- |";
  }
  text += "\n" + rule + "\n";
  for (std::size_t row = 0; row < rows; ++row) {
    text += "|";
    for (const Column& column : table.columns) {
      text += fmt::format(" {} |", markdown_escaped(shown(column, row, "")));
    }
    text += "\n";
  }
  return text;
}

}  // namespace linkstudy
