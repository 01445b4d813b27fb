// A table as text: for people (text, Markdown, LaTeX) with numbers in the column's form, for
// programs (CSV, JSON) with every bit. A number that is missing (NaN) is "-" in text, null in JSON,
// and nothing elsewhere.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "study/record/table.h"

namespace linkstudy {

inline constexpr std::size_t kNoWidth = std::numeric_limits<std::size_t>::max();

// A form of tables; a further one is a further row of the list in write_table.cpp.
struct TableFormat {
  std::string_view name;
  // Characters of a line: text only.
  std::string (*write)(const Table& table, std::size_t width);
};

std::span<const TableFormat> table_formats();

// By name; throws std::invalid_argument that lists them.
const TableFormat& table_format(std::string_view name);

// Aligned columns: names, units, a rule, rows. What is wider than `width` gets names over several
// lines, then stands upright if it is one row (a line for each column), then shortens texts, and in
// the end leaves out columns at the right, but not the one with role "status", and says so.
std::string text_of(const Table& table, std::size_t width = kNoWidth);
// GitHub's tables; units in brackets behind the names.
std::string markdown_of(const Table& table);
// RFC 4180 with 17 significant digits; a comment line "# units: ..." comes before the header.
std::string csv_of(const Table& table);
// {"title", "columns": [{"name", "unit"}], "rows": [{name: value}]}. Numbers in the shortest form
// that reads back to the same bits; missing numbers and those that are not finite are null.
std::string json_of(const Table& table);
// A tabular of the packages booktabs and siunitx: units in the head, numbers in columns S.
std::string latex_of(const Table& table);

// Characters of a line on standard output: of the terminal (COLUMNS, if set), else 100.
std::size_t output_width();

}  // namespace linkstudy
