#include "study/report/choose_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/topology/nearest_name.h"
#include "study/config/input_error.h"
#include "study/config/unit.h"
#include "study/report/table_cells.h"

namespace linkstudy {
namespace {

constexpr double kSameDigits = 5e-6;  // half a unit of the sixth digit of 1.00000

// Longer ones first: "<=" begins like "<".
constexpr std::array<std::string_view, 7> kOperators = {"==", "!=", "<=", ">=", "=", "<", ">"};

const Column& require_column(const Table& table, const std::string& name) {
  if (const Column* column = find_column(table, name)) return *column;
  std::vector<std::string> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  throw UsageError(fmt::format("there is no column '{}'; nearest: {}", name,
                               fmt::join(nearest_names(name, names, 3), ", ")));
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(' ') - begin + 1));
}

struct RowTest {
  std::string column;
  std::string_view sign;
  std::string value;
};

RowTest split_condition(const std::string& text) {
  const std::size_t at = text.find_first_of("=!<>");
  if (at != std::string::npos) {
    for (const std::string_view sign : kOperators) {
      if (!std::string_view(text).substr(at).starts_with(sign)) continue;
      RowTest one{trimmed(text.substr(0, at)), sign, trimmed(text.substr(at + sign.size()))};
      if (one.column.empty() || one.value.empty()) break;
      return one;
    }
  }
  throw UsageError(
      fmt::format("'{}' is no comparison; write COLUMN SIGN VALUE with one of = != < <= > >=, "
                  "joined by 'and'",
                  text));
}

std::vector<RowTest> split_conditions(std::string text) {
  std::vector<RowTest> all;
  for (std::size_t at = text.find(" and "); at != std::string::npos; at = text.find(" and ", at)) {
    text.replace(at, 5, ",");
  }
  if (trimmed(text).empty()) return all;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    all.push_back(split_condition(trimmed(text.substr(at, comma - at))));
    at = comma + 1;
  }
  return all;
}

// In the column's unit.
double read_number(const Column& column, const std::string& text) {
  const std::optional<WrittenQuantity> written = split_quantity(text);
  if (!written) {
    throw UsageError(fmt::format("column '{}' holds numbers, got '{}'", column.name, text));
  }
  if (written->unit.empty() || written->unit == column.unit) return written->value;
  const std::optional<Unit> from = parse_unit(written->unit);
  const std::optional<Unit> to = parse_unit(column.unit);
  if (from && to)
    if (const auto value = convert_unit(written->value, *from, *to)) return *value;
  throw UsageError(fmt::format("'{}' does not fit column '{}', which is in {}", text, column.name,
                               column.unit.empty() ? "pure numbers" : "'" + column.unit + "'"));
}

bool holds(double x, std::string_view sign, double value) {
  if (std::isnan(x)) return false;
  const bool is_equal = x == value || std::abs(x - value) <= kSameDigits * std::abs(value);
  if (sign == "!=") return !is_equal;
  if (sign == "<") return x < value && !is_equal;
  if (sign == ">") return x > value && !is_equal;
  if (sign == "<=") return x < value || is_equal;
  if (sign == ">=") return x > value || is_equal;
  return is_equal;
}

double number_at(const Column& column, std::size_t row) {
  return std::visit(
      [row](const auto& values) -> double {
        if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<std::string>>) {
          return NAN;
        } else {
          return static_cast<double>(values.at(row));
        }
      },
      column.values);
}

void keep_rows(const Table& table, const RowTest& wanted, std::vector<std::size_t>& rows) {
  const Column& column = require_column(table, wanted.column);
  if (is_number(column)) {
    const double value = read_number(column, wanted.value);
    std::erase_if(
        rows, [&](std::size_t row) { return !holds(number_at(column, row), wanted.sign, value); });
    return;
  }
  const bool differs = wanted.sign == "!=";
  if (!differs && wanted.sign != "=" && wanted.sign != "==") {
    throw UsageError(fmt::format("column '{}' holds words: compare with = or !=", column.name));
  }
  std::erase_if(
      rows, [&](std::size_t row) { return (shown(column, row, "") == wanted.value) == differs; });
}

}  // namespace

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    if (comma > at) parts.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return parts;
}

Table choose_columns(const Table& table, const std::vector<std::string>& names) {
  Table chosen{table.name};
  for (const std::string& name : names) chosen.columns.push_back(require_column(table, name));
  for (const Column& column : table.columns) {
    if (names.empty() && column.role != kOnDemand) chosen.columns.push_back(column);
  }
  return chosen;
}

Table choose_rows(const Table& table, const std::string& text) {
  std::vector<std::size_t> rows(row_count(table));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  for (const RowTest& wanted : split_conditions(text)) keep_rows(table, wanted, rows);
  return pick_rows(table, rows);
}

}  // namespace linkstudy
