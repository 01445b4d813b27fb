#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "study/report/table_cells.h"
#include "study/report/write_table.h"

namespace linkstudy {
namespace {

using Json = nlohmann::ordered_json;

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string safe = "\"";
  for (char c : text) safe += c == '"' ? "\"\"" : std::string(1, c);
  return safe + "\"";
}

std::string csv_cell(const Column& column, std::size_t row) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    const double number = numbers->at(row);
    return std::isnan(number) ? "" : fmt::format("{:.17g}", number);
  }
  const auto* texts = std::get_if<std::vector<std::string>>(&column.values);
  return quoted(texts != nullptr ? texts->at(row) : shown(column, row, ""));
}

template <class Content>
std::string csv_line(const Table& table, Content content) {
  return joined_columns(table, ",", content) + "\n";
}

}  // namespace

Json json_cell(const Column& column, std::size_t row) {
  return std::visit(
      [&](const auto& values) -> Json {
        const auto& value = values.at(row);
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::uint8_t>) {
          if (value < column.words.size()) return column.words[value];
        }
        return value;
      },
      column.values);
}

std::string csv_of(const Table& table) {
  std::string text =
      "# units: " + csv_line(table, [](const Column& column) { return quoted(column.unit); });
  text += csv_line(table, [](const Column& column) { return quoted(column.name); });
  const std::size_t rows = row_count(table);
  for (std::size_t row = 0; row < rows; ++row) {
    text += csv_line(table, [row](const Column& column) { return csv_cell(column, row); });
  }
  return text;
}

std::string json_of(const Table& table) {
  Json json = {{"title", table.name}, {"columns", Json::array()}, {"rows", Json::array()}};
  for (const Column& column : table.columns) {
    json["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
  }
  const std::size_t rows = row_count(table);
  for (std::size_t row = 0; row < rows; ++row) {
    Json object = Json::object();
    for (const Column& column : table.columns) object[column.name] = json_cell(column, row);
    json["rows"].push_back(std::move(object));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace linkstudy
