#include <fmt/format.h>

#include <cmath>

#include "study/report/table_cells.h"

namespace linkstudy {
namespace {

std::string escaped(std::string_view text) {
  std::string safe;
  for (char c : text) {
    switch (c) {
      case '\\':
        safe += "\\textbackslash{}";
        break;
      case '^':
        safe += "\\textasciicircum{}";
        break;
      case '~':
        safe += "\\textasciitilde{}";
        break;
      case '#':
      case '$':
      case '%':
      case '&':
      case '_':
      case '{':
      case '}':
        safe += '\\';
        [[fallthrough]];
      default:
        safe += c;
    }
  }
  return safe;
}

// "-2.5e-05" as $-2.5 \cdot 10^{-5}$.
std::string number(const std::string& digits) {
  const std::size_t e = digits.find('e');
  if (e == std::string::npos) {
    return fmt::format("${}$", digits);
  }
  return fmt::format("${} \\cdot 10^{{{}}}$", digits.substr(0, e), std::stoi(digits.substr(e + 1)));
}

std::string latex_cell(const TableColumn& column, const Cell& cell) {
  const std::string digits = shown(column, cell, "");
  const double* value = std::get_if<double>(&cell);
  if (value == nullptr || std::isnan(*value)) {
    return escaped(digits);
  }
  if (std::isinf(*value)) {
    return *value > 0 ? "$\\infty$" : "$-\\infty$";
  }
  return number(digits);
}

template <class Content>
std::string line(const Table& table, Content content) {
  return joined_columns(table, " & ", content) + " \\\\\n";
}

}  // namespace

std::string latex_of(const Table& table) {
  std::string alignment;
  for (const TableColumn& column : table.columns) {
    alignment += column.align == Align::right ? 'r' : 'l';
  }
  std::string text = fmt::format("\\begin{{tabular}}{{{}}}\n\\toprule\n", alignment);
  text += line(table, [&](std::size_t i) { return escaped(table.columns[i].name); });
  text += line(table, [&](std::size_t i) { return escaped(table.columns[i].unit); });
  text += "\\midrule\n";
  for (const std::vector<Cell>& row : table.rows) {
    text += line(
        table, [&](std::size_t i) { return latex_cell(table.columns[i], cell_of(table, row, i)); });
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace linkstudy
