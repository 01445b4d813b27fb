#include "study/record/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace linkstudy {
namespace {

template <class Item>
const Item* find_named(const std::vector<Item>& items, std::string_view name) {
  const auto found = std::ranges::find(items, name, &Item::name);
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

bool is_number(const Column& column) {
  return !std::holds_alternative<std::vector<std::string>>(column.values) && column.words.empty();
}

std::size_t row_count(const Column& column) {
  return std::visit([](const auto& values) { return values.size(); }, column.values);
}

std::size_t row_count(const Table& table) {
  if (table.columns.empty()) return 0;
  const Column& first = table.columns.front();
  for (const Column& column : table.columns) {
    if (row_count(column) == row_count(first)) continue;
    throw std::invalid_argument(fmt::format("table '{}': column '{}' has {} rows, '{}' has {}",
                                            table.name, column.name, row_count(column), first.name,
                                            row_count(first)));
  }
  return row_count(first);
}

const Column* find_column(const Table& table, std::string_view name) {
  return find_named(table.columns, name);
}

const Attribute* find_attribute(const Table& table, std::string_view name) {
  return find_named(table.attributes, name);
}

const Table* find_part(const Table& table, std::string_view name) {
  return find_named(table.parts, name);
}

void append_row(Table& table, std::span<const double> row) {
  if (row.size() != table.columns.size()) {
    throw std::invalid_argument(fmt::format("table '{}': a row has {} values, there are {} columns",
                                            table.name, row.size(), table.columns.size()));
  }
  for (std::size_t i = 0; i < row.size(); ++i) {
    std::get<std::vector<double>>(table.columns[i].values).push_back(row[i]);
  }
}

Table pick_rows(const Table& table, std::span<const std::size_t> rows) {
  Table picked = table;
  for (Column& column : picked.columns) {
    std::visit(
        [&](auto& values) {
          std::decay_t<decltype(values)> kept;
          for (const std::size_t row : rows) kept.push_back(values.at(row));
          values = std::move(kept);
        },
        column.values);
  }
  return picked;
}

}  // namespace linkstudy
