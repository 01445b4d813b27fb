// Plain values of a validated table; what is absent or was reported reads as a harmless one.
#pragma once

#include <initializer_list>
#include <string>

#include "study/config/tree.h"

namespace linkstudy {

double number_of(const Tree& table, std::string_view key, double otherwise);
std::int64_t integer_of(const Tree& table, std::string_view key, std::int64_t otherwise);
std::string word_of(const Tree& table, std::string_view key);

// None of the table's values, as far as they are written, was reported.
bool are_known(const Tree& table, std::initializer_list<std::string_view> keys);

}  // namespace linkstudy
