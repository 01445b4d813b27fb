// Quantities with units, such as "60 deg", "1e6 N/m", "10 N m", "5 g/cm^3", "2 m s^-2".
//   quantity = number unit       unit = factor { ["*" | "/"] factor }
//   factor   = (symbol | "(" unit ")" | "1") ["^" integer | superscript 2 or 3]
// A "/" divides by the next factor only: N s/m and N/m s are the same unit.
// Angles are a dimension of their own, so that degrees never pass for metres or pure numbers.
// Symbols with SI prefixes (n u m c d h k M G ...): m g s N J W Pa Hz rad bar t Nm.
// Without: deg rev rpm min h %.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace linkstudy {

struct Unit {
  double factor = 1.0;              // to SI (kg, m, s, rad)
  std::array<int, 4> dimensions{};  // exponents of m, kg, s, rad
};

struct WrittenQuantity {
  double value = 0.0;  // as written
  std::string unit;    // as written
};

// Nothing, when the text is no unit; `fault` then says which part.
std::optional<Unit> parse_unit(std::string_view text, std::string* fault = nullptr);

// Splits "60 deg" into its number and the rest; nothing when it does not start with a number.
std::optional<WrittenQuantity> split_quantity(std::string_view text);

// Converts `value from` to the unit `to`; nothing when the dimensions differ.
std::optional<double> convert_unit(double value, const Unit& from, const Unit& to);

}  // namespace linkstudy
