#include "study/report/results_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "study/record/digest.h"
#include "study/store/results_tree.h"

namespace linkstudy {
namespace {

TableColumn head_of(const DataColumn& column) {
  if (std::holds_alternative<std::vector<double>>(column.values)) {
    return {column.name, column.unit, "{:.6g}", Align::right};
  }
  if (std::holds_alternative<std::vector<std::string>>(column.values) ||
      !column.flag_meanings.empty()) {
    return {column.name, column.unit, "{}", Align::left};
  }
  return {column.name, column.unit, "{:.0f}", Align::right};
}

Cell cell_at(const DataColumn& column, std::size_t row) {
  return std::visit(
      [&](const auto& values) -> Cell {
        if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<std::string>>) {
          return values[row];
        } else {
          const auto value = values[row];
          const auto index = static_cast<std::size_t>(value);
          if (index < column.flag_meanings.size()) {
            return column.flag_meanings[index];
          }
          return static_cast<double>(value);
        }
      },
      column.values);
}

const DataColumn& wanted_column(const DataGroup& group, const std::string& name) {
  if (const DataColumn* column = find_column(group, name)) {
    return *column;
  }
  std::vector<std::string> names;
  std::ranges::transform(group.columns, std::back_inserter(names), &DataColumn::name);
  throw std::invalid_argument(
      fmt::format("there is no column '{}'; there are: {}", name, fmt::join(names, ", ")));
}

Table table_of_columns(const std::string& title, const std::vector<const DataColumn*>& columns) {
  Table table{title, {}, {}};
  if (columns.empty()) {
    return table;
  }
  table.rows.resize(row_count(*columns.front()));
  for (const DataColumn* column : columns) {
    table.columns.push_back(head_of(*column));
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      table.rows[row].push_back(cell_at(*column, row));
    }
  }
  return table;
}

std::vector<const DataColumn*> pick(const DataGroup& group, const std::vector<std::string>& names) {
  std::vector<const DataColumn*> columns;
  for (const std::string& name : names) {
    columns.push_back(&wanted_column(group, name));
  }
  return columns;
}

bool has_content(const DataColumn& column) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values)) {
    return std::ranges::any_of(*texts, [](const std::string& text) { return !text.empty(); });
  }
  const auto* numbers = std::get_if<std::vector<std::int64_t>>(&column.values);
  return numbers != nullptr &&
         std::ranges::any_of(*numbers, [](std::int64_t id) { return id >= 0; });
}

std::vector<const DataColumn*> default_columns(const DataGroup& study) {
  std::vector<const DataColumn*> columns;
  for (const DataColumn& column : study.columns) {
    const bool optional = column.role == "parent";
    if (column.role != "attempts" && (!optional || has_content(column))) {
      columns.push_back(&column);
    }
  }
  return columns;
}

}  // namespace

Table results_table(const StudyResults& results, const ResultsTableOptions& options) {
  const std::vector<Evaluation> evaluations = latest_by_id(results.evaluations);
  DataGroup group = study_group(results.description, evaluations);
  if (options.columns.empty()) {
    return table_of_columns(results.description.name, default_columns(group));
  }
  DataGroup runtime = runtime_group(evaluations);
  group.columns.insert(group.columns.end(), runtime.columns.begin() + 1, runtime.columns.end());
  return table_of_columns(results.description.name, pick(group, options.columns));
}

Table table_of(const DataGroup& group, const std::vector<std::string>& columns) {
  if (!columns.empty()) {
    return table_of_columns(group.name, pick(group, columns));
  }
  std::vector<const DataColumn*> all;
  for (const DataColumn& column : group.columns) {
    all.push_back(&column);
  }
  return table_of_columns(group.name, all);
}

Table provenance_table(const StudyResults& results) {
  Table table = table_of(provenance_group(results.provenance, {}));
  for (TableColumn& column : table.columns) {
    if (column.name == "time") {
      column.unit = "s since 1970";
      column.format = "{:.0f}";
    }
  }
  return table;
}

}  // namespace linkstudy
