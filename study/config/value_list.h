// The values of a varied parameter from one of
//   values = [...]                        as they stand
//   lin = [first, last, n]                first + (last - first) i / (n - 1)
//   log = [first, last, n]                10^(log10 first + (log10 last - log10 first) i / (n - 1))
//   ladder = { from, ratio, levels }      from ratio^i
// with i = 0 .. n - 1; first and last are met exactly. Texts with units are converted to `unit`.
// Where the design says how many there are, lin and log are [first, last].
#pragma once

#include <optional>

#include "study/config/key.h"

namespace linkstudy {

// `vary` is a validated [[vary]] table; `row` describes the parameter, `count` what the design
// says. Empty when it was reported.
std::vector<Tree> read_value_list(Tree& vary, const KeyRow& row, const std::string& unit,
                                  const std::string& parameter, std::optional<std::size_t> count,
                                  Diagnostics& diagnostics);

// One value against the row of its parameter; false, and invalid, when it was reported.
bool validate_value(Tree& value, const KeyRow& row, const std::string& unit,
                    const std::string& parameter, Diagnostics& diagnostics);

// A parameter that takes numbers between others.
bool is_numeric_row(const KeyRow& row);

}  // namespace linkstudy
