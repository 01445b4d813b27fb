// Plain values of a validated table; what is absent or was reported reads as a harmless one.
#pragma once

#include <string>
#include <vector>

#include "study/config/tree.h"

namespace linkstudy {

double number_of(const Tree& table, std::string_view key, double otherwise);
std::int64_t integer_of(const Tree& table, std::string_view key, std::int64_t otherwise);
std::string word_of(const Tree& table, std::string_view key);
bool flag_of(const Tree& table, std::string_view key);
std::vector<double> numbers_of(const Tree& table, std::string_view key);

// "joint 'A': "
std::string title(const char* kind, const Tree& record);

// "SUBJECT must be in m here, got a value in rad"; the value becomes invalid.
void report_unit(Tree& value, const std::string& subject, const std::string& unit,
                 Diagnostics& diagnostics);

}  // namespace linkstudy
