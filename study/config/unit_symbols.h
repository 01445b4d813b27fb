// The symbols of units, the one statement of each: what is accepted, its size in SI units, and what
// `linkstudy describe units` says of it. Inch, foot, pound and what is made of them are exact
// (international yard and pound agreement of 1959: 0.0254 m, 0.3048 m, 0.45359237 kg); standard
// gravity is 9.80665 m/s^2 (3rd CGPM, 1901), so that a pound force is 4.4482216152605 N.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace linkstudy {

struct Unit {
  double factor = 1.0;              // to SI (kg, m, s, rad)
  std::array<int, 4> dimensions{};  // exponents of m, kg, s, rad
};

struct UnitSymbol {
  std::string_view name;
  bool takes_prefix;
  Unit unit;
  std::string_view meaning;
};

struct UnitPrefix {
  std::string_view name;
  double factor;
};

std::span<const UnitSymbol> unit_symbols();
std::span<const UnitPrefix> unit_prefixes();

// A symbol, with or without a prefix; nothing when there is none of that name.
std::optional<Unit> find_unit_symbol(std::string_view name);

// What a writer of `name` probably meant: "mm" for "milimeter" or "Millimetres", "kN" for "KN".
// Empty when nothing is near.
std::string nearest_unit(std::string_view name);

// "kg m/s^2" of an exponent each of m, kg, s, rad; "1" for none.
std::string dimension_text(const std::array<int, 4>& dimensions);

// The text of `linkstudy describe units`.
std::string describe_units();

}  // namespace linkstudy
