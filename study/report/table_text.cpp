#include <algorithm>

#include "study/report/table_cells.h"

namespace linkstudy {
namespace {

constexpr std::string_view kGap = "  ";

// Characters of a UTF-8 text: all bytes but continuation bytes.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

using Lines = std::vector<std::vector<std::string>>;  // rows of shown cells

Lines lines_of(const Table& table) {
  Lines lines(1);
  const bool units =
      std::ranges::any_of(table.columns, [](const TableColumn& c) { return !c.unit.empty(); });
  for (const TableColumn& column : table.columns) {
    lines[0].push_back(column.name);
  }
  if (units) {
    lines.emplace_back();
    std::ranges::transform(table.columns, std::back_inserter(lines[1]), &TableColumn::unit);
  }
  lines.emplace_back();  // the rule, drawn when the widths are known
  for (const std::vector<Cell>& row : table.rows) {
    lines.emplace_back();
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      lines.back().push_back(shown(table.columns[i], cell_of(table, row, i), "-"));
    }
  }
  return lines;
}

std::vector<std::size_t> widths_of(const Table& table, const Lines& lines) {
  std::vector<std::size_t> widths(table.columns.size(), 0);
  for (const std::vector<std::string>& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      widths[i] = std::max(widths[i], width(line[i]));
    }
  }
  return widths;
}

std::string aligned(const Table& table, const std::vector<std::string>& line,
                    const std::vector<std::size_t>& widths) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::string padding(widths[i] - width(line[i]), ' ');
    text += i == 0 ? "" : kGap;
    text += table.columns[i].align == Align::right ? padding + line[i] : line[i] + padding;
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

}  // namespace

std::string text_of(const Table& table) {
  Lines lines = lines_of(table);
  const std::vector<std::size_t> widths = widths_of(table, lines);
  for (std::vector<std::string>& line : lines) {
    if (line.empty()) {
      std::ranges::transform(widths, std::back_inserter(line),
                             [](std::size_t count) { return std::string(count, '-'); });
    }
  }
  std::string text = table.title.empty() ? "" : table.title + "\n";
  for (const std::vector<std::string>& line : lines) {
    text += aligned(table, line, widths);
  }
  return text;
}

}  // namespace linkstudy
