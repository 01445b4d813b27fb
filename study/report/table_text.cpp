#include <fmt/format.h>

#include <algorithm>

#include "study/record/lines.h"
#include "study/report/table_cells.h"
#include "study/report/write_table.h"

namespace linkstudy {
namespace {

constexpr std::string_view kGap = "  ";
constexpr std::size_t kHeadWidth = 8;     // names are broken into lines of no less
constexpr std::size_t kLongestText = 40;  // of a cell, where the width ends

struct TextColumn {
  std::vector<std::string> head;  // lines of the name
  std::string unit;
  std::vector<std::string> cells;
  bool is_number = false;
  bool is_status = false;
  std::size_t body_width = 0;  // of unit and cells

  void measure() {
    body_width = text_width(unit);
    for (const std::string& cell : cells) body_width = std::max(body_width, text_width(cell));
  }
  std::size_t width() const {
    std::size_t most = body_width;
    for (const std::string& line : head) most = std::max(most, text_width(line));
    return most;
  }
};

using TextColumns = std::vector<TextColumn>;

TextColumns columns_of(const Table& table) {
  TextColumns columns;
  const std::size_t rows = row_count(table);
  for (const Column& column : table.columns) {
    columns.push_back({{column.name}, column.unit, {}, is_number(column), column.role == "status"});
    for (std::size_t row = 0; row < rows; ++row) {
      columns.back().cells.push_back(shown(column, row, "-"));
    }
    columns.back().measure();
  }
  return columns;
}

std::size_t width_of(const TextColumns& columns) {
  std::size_t sum = 0;
  for (const TextColumn& column : columns) sum += column.width() + (sum > 0 ? kGap.size() : 0);
  return sum;
}

// Names over as few lines as it takes to fit: the one that is widest beyond its column's content
// first.
void wrap_heads(TextColumns& columns, std::size_t width) {
  std::vector<std::string> names;
  std::vector<std::size_t> limits;
  for (const TextColumn& column : columns) {
    names.push_back(column.head.front());
    limits.push_back(column.width());
  }
  const auto excess = [&](std::size_t i) {
    const std::size_t least = std::max(columns[i].body_width, kHeadWidth);
    return limits[i] > least ? limits[i] - least : 0;
  };
  while (width_of(columns) > width) {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < columns.size(); ++i)
      if (excess(i) > excess(widest)) widest = i;
    if (excess(widest) == 0) return;
    --limits[widest];
    columns[widest].head = wrapped(names[widest], limits[widest]);
  }
}

void shorten_texts(TextColumns& columns) {
  for (TextColumn& column : columns) {
    for (std::string& cell : column.cells) {
      if (text_width(cell) <= kLongestText) continue;
      std::size_t end = 0;
      while (text_width(std::string_view(cell).substr(0, end)) < kLongestText - 3) ++end;
      while ((static_cast<unsigned char>(cell[end]) & 0xC0u) == 0x80u) ++end;
      cell = cell.substr(0, end) + "...";
    }
    column.measure();
  }
}

void add_line(std::string& text, const std::string& line) {
  text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

// content(column) of all columns, aligned.
template <class Content>
void add_aligned(std::string& text, const TextColumns& columns, Content content) {
  std::string line;
  for (const TextColumn& column : columns) {
    const std::string cell = content(column);
    const std::string padding(column.width() - text_width(cell), ' ');
    line += &column == &columns.front() ? "" : kGap;
    line += column.is_number ? padding + cell : cell + padding;
  }
  add_line(text, line);
}

std::string lines_of(const TextColumns& columns, std::size_t rows) {
  std::string text;
  std::size_t head_lines = 0;
  bool has_units = false;
  for (const TextColumn& column : columns) {
    head_lines = std::max(head_lines, column.head.size());
    has_units = has_units || !column.unit.empty();
  }
  for (std::size_t i = 0; i < head_lines; ++i) {
    add_aligned(text, columns, [&](const TextColumn& column) {
      const std::size_t above = head_lines - column.head.size();
      return i < above ? std::string() : column.head[i - above];
    });
  }
  if (has_units) add_aligned(text, columns, [](const TextColumn& column) { return column.unit; });
  add_aligned(text, columns,
              [](const TextColumn& column) { return std::string(column.width(), '-'); });
  for (std::size_t row = 0; row < rows; ++row) {
    add_aligned(text, columns, [row](const TextColumn& column) { return column.cells[row]; });
  }
  return text;
}

// Leaves out columns from the right till the others fit; the status stays.
void leave_out(TextColumns& columns, std::size_t width) {
  while (width_of(columns) > width && columns.size() > 1) {
    const bool is_status = columns.back().is_status && columns.size() > 2;
    columns.erase(columns.end() - (is_status ? 2 : 1));
  }
}

// A line for each column.
std::string upright(const TextColumns& columns) {
  std::size_t width = 0;
  for (const TextColumn& column : columns) width = std::max(width, text_width(column.head.front()));
  std::string text;
  for (const TextColumn& column : columns) {
    const std::string padding(width - text_width(column.head.front()), ' ');
    const bool has_unit = !column.unit.empty() && column.cells.front() != "-";
    const std::string unit = has_unit ? " " + column.unit : "";
    add_line(text, column.head.front() + padding + std::string(kGap) + column.cells.front() + unit);
  }
  return text;
}

}  // namespace

std::string text_of(const Table& table, std::size_t width) {
  const std::size_t rows = row_count(table);
  std::string text = table.name.empty() ? "" : table.name + "\n";
  TextColumns columns = columns_of(table);
  if (width_of(columns) > width && rows == 1) return text + upright(columns);
  wrap_heads(columns, width);
  if (width_of(columns) > width) shorten_texts(columns);
  leave_out(columns, width);
  text += lines_of(columns, rows);
  if (columns.size() == table.columns.size()) return text;
  return text +
         fmt::format("{} of {} columns fit; export --format csv has all, --columns chooses\n",
                     columns.size(), table.columns.size());
}

}  // namespace linkstudy
