// The one table of the program: named columns of equal length, each of one type, with its unit, its
// meaning, its role and its form. Results files (store), text, CSV, Markdown, LaTeX and JSON
// (report) are written from it. Nothing here knows studies or mechanics.
// A number that is NaN is missing. A first column with role "axis" (numbers) is what the others are
// over; without one the rows are numbered. Names are free text. A table may carry attributes and
// further tables: with them it is a group of a results file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "study/record/bytes.h"

namespace linkstudy {

using ColumnValues = std::variant<std::vector<double>, std::vector<std::int64_t>,
                                  std::vector<std::uint8_t>, std::vector<std::string>>;

struct Column {
  std::string name;       // "closure.S.force.x"
  std::string unit{};     // SI, or "%"; "" for pure numbers and words
  std::string meaning{};  // in words
  std::string role{};     // "axis", "parameter", "response", ...
  ColumnValues values{};
  std::vector<std::string> words{};  // of bytes: word i is the meaning of value i
  std::string format = "{:.6g}";     // of floating numbers where people read them, as in fmt

  bool operator==(const Column&) const = default;
};

struct Attribute {
  std::string name;
  std::variant<std::string, double, std::int64_t, std::uint64_t> value;

  bool operator==(const Attribute&) const = default;
};

struct Table {
  std::string name;
  std::vector<Column> columns{};
  std::vector<Attribute> attributes{};
  std::vector<Table> parts{};
  bool compressed = false;  // in a file: chunked, shuffled and deflated; for long histories

  bool operator==(const Table&) const = default;
};

template <class Archive, Like<ColumnValues> Values>
void visit_members(Archive& archive, Values& values) {
  visit_variant(archive, values);
}

void visit_members(auto& archive, Like<Column> auto& column) {
  archive(column.name, column.unit, column.meaning, column.role, column.values, column.words,
          column.format);
}

void visit_members(auto& archive, Like<Attribute> auto& attribute) {
  archive(attribute.name);
  visit_variant(archive, attribute.value);
}

void visit_members(auto& archive, Like<Table> auto& table) {
  archive(table.name, table.columns, table.attributes, table.parts, table.compressed);
}

// Numbers, or words.
bool is_number(const Column& column);

std::size_t row_count(const Column& column);
// Of all columns. Throws std::invalid_argument where they differ.
std::size_t row_count(const Table& table);

// The part with a name, or null.
const Column* find_column(const Table& table, std::string_view name);
const Attribute* find_attribute(const Table& table, std::string_view name);
const Table* find_part(const Table& table, std::string_view name);

// A value for each column, all of them of floating numbers.
void append_row(Table& table, std::span<const double> row);

// The rows with these numbers, in their order.
Table pick_rows(const Table& table, std::span<const std::size_t> rows);

// The values of a column from the rows of a record: column_of(rows, [](const Row& r) { ... }).
template <class Row, class Field>
auto column_of(const std::vector<Row>& rows, Field field) {
  std::vector<std::decay_t<decltype(field(rows.front()))>> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(field(row));
  return values;
}

// A table of one list of rows, column by column.
template <class Row>
class TableOf {
 public:
  // `role`: of all columns.
  TableOf(std::string name, std::string role, std::vector<Row> rows)
      : table_{std::move(name)}, role_(std::move(role)), rows_(std::move(rows)) {}

  template <class Field>
  void add(std::string name, std::string unit, std::string meaning, Field field,
           const char* format = "{:.6g}") {
    table_.columns.push_back({std::move(name),
                              std::move(unit),
                              std::move(meaning),
                              role_,
                              column_of(rows_, field),
                              {},
                              format});
  }

  Table take() { return std::move(table_); }

 private:
  Table table_;
  std::string role_;
  std::vector<Row> rows_;
};

}  // namespace linkstudy
