#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "study/report/table_cells.h"

namespace linkstudy {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string safe = "\"";
  for (char c : text) {
    safe += c == '"' ? "\"\"" : std::string(1, c);
  }
  return safe + "\"";
}

std::string csv_cell(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) {
    return fmt::format("{:.17g}", *number);
  }
  const std::string* text = std::get_if<std::string>(&cell);
  return text == nullptr ? "" : quoted(*text);
}

template <class Content>
std::string csv_line(const Table& table, Content content) {
  return joined_columns(table, ",", content) + "\n";
}

nlohmann::ordered_json json_cell(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) {
    return *number;
  }
  const std::string* text = std::get_if<std::string>(&cell);
  return text == nullptr ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(*text);
}

}  // namespace

std::string csv_of(const Table& table) {
  std::string text =
      "# units: " + csv_line(table, [&](std::size_t i) { return quoted(table.columns[i].unit); });
  text += csv_line(table, [&](std::size_t i) { return quoted(table.columns[i].name); });
  for (const std::vector<Cell>& row : table.rows) {
    text += csv_line(table, [&](std::size_t i) { return csv_cell(cell_of(table, row, i)); });
  }
  return text;
}

std::string json_of(const Table& table) {
  using Json = nlohmann::ordered_json;
  Json json = {{"title", table.title}, {"columns", Json::array()}, {"rows", Json::array()}};
  for (const TableColumn& column : table.columns) {
    json["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
  }
  for (const std::vector<Cell>& row : table.rows) {
    Json object = Json::object();
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      object[table.columns[i].name] = json_cell(cell_of(table, row, i));
    }
    json["rows"].push_back(std::move(object));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

TableFormat table_format(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, TableFormat>, 5> kNames = {
      {{"text", TableFormat::text},
       {"csv", TableFormat::csv},
       {"md", TableFormat::markdown},
       {"json", TableFormat::json},
       {"latex", TableFormat::latex}}};
  for (const auto& [known, format] : kNames) {
    if (known == name) {
      return format;
    }
  }
  throw std::invalid_argument(
      fmt::format("unknown format '{}'; choose text, csv, md, json or latex", name));
}

std::string write_table(const Table& table, TableFormat format) {
  switch (format) {
    case TableFormat::csv:
      return csv_of(table);
    case TableFormat::markdown:
      return markdown_of(table);
    case TableFormat::json:
      return json_of(table);
    case TableFormat::latex:
      return latex_of(table);
    case TableFormat::text:
      break;
  }
  return text_of(table);
}

}  // namespace linkstudy
