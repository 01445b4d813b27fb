// The one table of the program: columns with a name, a unit and a form, rows of numbers, texts and
// missing cells. Text, Markdown and LaTeX print numbers in the column's form, for people; CSV and
// JSON keep every bit, for programs.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace linkstudy {

enum class Align { left, right };

struct TableColumn {
  std::string name;
  std::string unit;               // "" where there is none
  std::string format = "{:.6g}";  // of numbers, as in fmt
  Align align = Align::right;
};

// monostate: nothing to show.
using Cell = std::variant<std::monostate, double, std::string>;

struct Table {
  std::string title;
  std::vector<TableColumn> columns;
  std::vector<std::vector<Cell>> rows;  // one cell per column; shorter rows end in missing cells
};

enum class TableFormat { text, csv, markdown, json, latex };

// "text", "csv", "md", "json", "latex"; throws std::invalid_argument that lists them.
TableFormat table_format(std::string_view name);

std::string write_table(const Table& table, TableFormat format);

// Aligned columns: names, units, a rule, rows. A missing cell is "-".
std::string text_of(const Table& table);
// GitHub's tables; units in brackets behind the names.
std::string markdown_of(const Table& table);
// RFC 4180 with 17 significant digits; a comment line "# units: ..." comes before the header.
std::string csv_of(const Table& table);
// {"title", "columns": [{"name", "unit"}], "rows": [{name: value}]}. Numbers in the shortest form
// that reads back to the same bits; missing cells and numbers that are not finite are null.
std::string json_of(const Table& table);
// A tabular of the package booktabs, powers of ten as such.
std::string latex_of(const Table& table);

}  // namespace linkstudy
