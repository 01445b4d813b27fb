#include "study/config/read_value.h"

#include <fmt/format.h>

namespace linkstudy {

double number_of(const Tree& table, std::string_view key, double otherwise) {
  const Tree* value = table.find(key);
  return value != nullptr && value->is_numeric() ? value->as_number() : otherwise;
}

std::int64_t integer_of(const Tree& table, std::string_view key, std::int64_t otherwise) {
  const Tree* value = table.find(key);
  return value != nullptr && value->is(Tree::Kind::integer) ? value->integer : otherwise;
}

std::string word_of(const Tree& table, std::string_view key) {
  const Tree* value = table.find(key);
  return value != nullptr && value->is(Tree::Kind::text) ? value->text : std::string();
}

bool flag_of(const Tree& table, std::string_view key) {
  const Tree* value = table.find(key);
  return value != nullptr && value->is(Tree::Kind::boolean) && value->boolean;
}

std::vector<double> numbers_of(const Tree& table, std::string_view key) {
  std::vector<double> numbers;
  const Tree* value = table.find(key);
  if (value == nullptr || !value->is(Tree::Kind::array)) return numbers;
  for (const Tree& item : value->items) numbers.push_back(item.as_number());
  return numbers;
}

std::string title(const char* kind, const Tree& record) {
  return fmt::format("{} '{}': ", kind, word_of(record, "name"));
}

void report_unit(Tree& value, const std::string& subject, const std::string& unit,
                 Diagnostics& diagnostics) {
  diagnostics.add(value.at,
                  fmt::format("{} must be {} here, got a value in {}", subject,
                              unit == "1" ? "a pure number" : "in " + unit, value.text),
                  "the joint type and the load type decide between lengths and angles");
  value.kind = Tree::Kind::invalid;
}

}  // namespace linkstudy
