#include "study/config/read_value.h"

#include <algorithm>

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

bool are_known(const Tree& table, std::initializer_list<std::string_view> keys) {
  return std::ranges::all_of(keys, [&](std::string_view key) {
    const Tree* value = table.find(key);
    return value == nullptr || value->is_valid();
  });
}

}  // namespace linkstudy
