// Quantities with units, such as "60 deg", "1e6 N/m", "10 N m", "5 g/cm^3", "2 m s^-2".
//   quantity = number unit       unit = factor { ["*" | "." | "-" | "/"] factor }
//   factor   = (symbol | "(" unit ")" | "1") [("^" | "**") integer | superscript 2 or 3]
// A "/" divides by the next factor only: N s/m and N/m s are the same unit. A "-" stands between
// letters only ("lbf-ft"), so that "s-1" is not taken for s. Angles are a dimension of their own,
// so that degrees never pass for metres or pure numbers. Symbols: unit_symbols.h.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "study/config/unit_symbols.h"

namespace linkstudy {

struct WrittenQuantity {
  double value = 0.0;  // as written
  std::string unit;    // as written
};

// What is wrong with the text of a unit.
struct UnitFault {
  std::string part;  // the part that is none, quoted
  std::string hint;  // "did you mean mm?"; empty when nothing is near
};

// Nothing, when the text is no unit; `fault` then says which part.
std::optional<Unit> parse_unit(std::string_view text, UnitFault* fault = nullptr);

// Splits "60 deg" into its number and the rest; nothing when it does not start with a number.
std::optional<WrittenQuantity> split_quantity(std::string_view text);

// Converts `value from` to the unit `to`; nothing when the dimensions differ.
std::optional<double> convert_unit(double value, const Unit& from, const Unit& to);

// Where two dimensions differ by angles alone, how they go together; else empty.
std::string explain_angle(const Unit& from, const Unit& to);

}  // namespace linkstudy
