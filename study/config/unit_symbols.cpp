#include "study/config/unit_symbols.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "core/topology/nearest_name.h"

namespace linkstudy {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInch = 0.0254;
constexpr double kFoot = 0.3048;
constexpr double kPound = 0.45359237;
constexpr double kGravity = 9.80665;
constexpr double kPoundForce = 4.4482216152605;  // kPound kGravity, exact

constexpr std::array<int, 4> kNone = {0, 0, 0, 0};
constexpr std::array<int, 4> kLength = {1, 0, 0, 0};
constexpr std::array<int, 4> kMass = {0, 1, 0, 0};
constexpr std::array<int, 4> kTime = {0, 0, 1, 0};
constexpr std::array<int, 4> kAngle = {0, 0, 0, 1};
constexpr std::array<int, 4> kSpeedOfTurn = {0, 0, -1, 1};
constexpr std::array<int, 4> kForce = {1, 1, -2, 0};
constexpr std::array<int, 4> kTorque = {2, 1, -2, 0};
constexpr std::array<int, 4> kPower = {2, 1, -3, 0};
constexpr std::array<int, 4> kPressure = {-1, 1, -2, 0};
constexpr std::array<int, 4> kAcceleration = {1, 0, -2, 0};

constexpr UnitSymbol kSymbols[] = {
    {"m", true, {1.0, kLength}, "metre"},
    {"in", false, {kInch, kLength}, "inch"},
    {"ft", false, {kFoot, kLength}, "foot"},
    {"g", true, {1.0e-3, kMass}, "gram"},
    {"t", true, {1.0e3, kMass}, "tonne"},
    {"lb", false, {kPound, kMass}, "pound (mass)"},
    {"lbm", false, {kPound, kMass}, "pound (mass)"},
    {"slug", false, {kPoundForce / kFoot, kMass}, "lbf s^2/ft"},
    {"s", true, {1.0, kTime}, "second"},
    {"min", false, {60.0, kTime}, "minute"},
    {"h", false, {3600.0, kTime}, "hour"},
    {"rad", true, {1.0, kAngle}, "radian"},
    {"deg", false, {kPi / 180.0, kAngle}, "degree"},
    {"\u00B0", false, {kPi / 180.0, kAngle}, "degree"},
    {"gon", false, {kPi / 200.0, kAngle}, "gon, 1/400 of a turn"},
    {"rev", false, {2.0 * kPi, kAngle}, "revolution"},
    {"rpm", false, {kPi / 30.0, kSpeedOfTurn}, "revolutions a minute"},
    {"RPM", false, {kPi / 30.0, kSpeedOfTurn}, "revolutions a minute"},
    {"Hz", true, {1.0, {0, 0, -1, 0}}, "hertz, a rate in time; of a turn write rev/s"},
    {"N", true, {1.0, kForce}, "newton"},
    {"kgf", false, {kGravity, kForce}, "kilogram force"},
    {"kp", false, {kGravity, kForce}, "kilogram force"},
    {"lbf", false, {kPoundForce, kForce}, "pound force"},
    {"kip", false, {1000.0 * kPoundForce, kForce}, "1000 lbf"},
    {"Nm", true, {1.0, kTorque}, "newton metre"},
    {"Ncm", false, {1.0e-2, kTorque}, "newton centimetre"},
    {"Nmm", false, {1.0e-3, kTorque}, "newton millimetre"},
    {"J", true, {1.0, kTorque}, "joule"},
    {"W", true, {1.0, kPower}, "watt"},
    {"Pa", true, {1.0, kPressure}, "pascal"},
    {"bar", true, {1.0e5, kPressure}, "bar"},
    {"psi", false, {kPoundForce / (kInch * kInch), kPressure}, "lbf/in^2"},
    {"ksi", false, {1000.0 * kPoundForce / (kInch * kInch), kPressure}, "1000 lbf/in^2"},
    {"g0", false, {kGravity, kAcceleration}, "standard gravity"},
    {"%", false, {0.01, kNone}, "a hundredth"},
};

constexpr UnitPrefix kPrefixes[] = {
    {"p", 1e-12}, {"n", 1e-9}, {"u", 1e-6}, {"\u00B5", 1e-6}, {"\u03BC", 1e-6},
    {"m", 1e-3},  {"c", 1e-2}, {"d", 1e-1}, {"da", 1e1},      {"h", 1e2},
    {"k", 1e3},   {"M", 1e6},  {"G", 1e9},  {"T", 1e12},
};

// Words are not units here (a file reads the same in every language), but they lead to them.
struct UnitWord {
  std::string_view word;
  std::string_view symbol;
};

constexpr UnitWord kUnitWords[] = {
    {"meter", "m"},         {"metre", "m"},         {"micrometer", "um"},  {"micron", "um"},
    {"micrometre", "um"},   {"millimeter", "mm"},   {"millimetre", "mm"},  {"centimeter", "cm"},
    {"centimetre", "cm"},   {"kilometer", "km"},    {"kilometre", "km"},   {"inch", "in"},
    {"inches", "in"},       {"foot", "ft"},         {"feet", "ft"},        {"gram", "g"},
    {"kilogram", "kg"},     {"tonne", "t"},         {"pound", "lb"},       {"second", "s"},
    {"sec", "s"},           {"millisecond", "ms"},  {"microsecond", "us"}, {"minute", "min"},
    {"hour", "h"},          {"radian", "rad"},      {"degree", "deg"},     {"revolution", "rev"},
    {"turn", "rev"},        {"hertz", "Hz"},        {"newton", "N"},       {"kilonewton", "kN"},
    {"newtonmeter", "N m"}, {"newtonmetre", "N m"}, {"joule", "J"},        {"watt", "W"},
    {"kilowatt", "kW"},     {"pascal", "Pa"},       {"megapascal", "MPa"}, {"gigapascal", "GPa"},
    {"percent", "%"},
};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

// The symbol that differs in upper and lower case only, if there is just one: "KN", "hz", "mpa" is
// two.
std::string same_letters(std::string_view name) {
  std::string found;
  const auto consider = [&](const std::string& candidate) {
    if (lower(candidate) != lower(name)) return true;
    const bool is_first = found.empty();
    if (is_first) found = candidate;
    return is_first;
  };
  for (const UnitSymbol& symbol : kSymbols) {
    if (!consider(std::string(symbol.name))) return {};
    if (!symbol.takes_prefix) continue;
    for (const UnitPrefix& prefix : kPrefixes) {
      if (!consider(std::string(prefix.name) + std::string(symbol.name))) return {};
    }
  }
  return found;
}

std::string symbol_of_word(std::string_view name) {
  std::string word = lower(name);
  if (word.size() < 3) return {};
  std::vector<std::string> words;
  for (const UnitWord& known : kUnitWords) {
    words.emplace_back(known.word);
    words.push_back(std::string(known.word) + "s");
  }
  const std::string near = nearest_name(word, words);
  const auto at = std::ranges::find(words, near);
  return at == words.end() ? std::string()
                           : std::string(kUnitWords[(at - words.begin()) / 2].symbol);
}

}  // namespace

std::span<const UnitSymbol> unit_symbols() {
  return kSymbols;
}

std::span<const UnitPrefix> unit_prefixes() {
  return kPrefixes;
}

std::optional<Unit> find_unit_symbol(std::string_view name) {
  for (const UnitSymbol& symbol : kSymbols)
    if (symbol.name == name) return symbol.unit;
  for (const UnitPrefix& prefix : kPrefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (const UnitSymbol& symbol : kSymbols) {
      if (!symbol.takes_prefix || symbol.name != name.substr(prefix.name.size())) continue;
      return Unit{prefix.factor * symbol.unit.factor, symbol.unit.dimensions};
    }
  }
  return std::nullopt;
}

std::string nearest_unit(std::string_view name) {
  const std::string near = same_letters(name);
  return near.empty() ? symbol_of_word(name) : near;
}

std::string dimension_text(const std::array<int, 4>& dimensions) {
  constexpr std::size_t kOrder[] = {1, 0, 2, 3};  // kg m s rad
  constexpr const char* kNames[] = {"m", "kg", "s", "rad"};
  std::vector<std::string> above;
  std::vector<std::string> below;
  for (const std::size_t i : kOrder) {
    const int power = std::abs(dimensions[i]);
    if (power == 0) continue;
    std::vector<std::string>& side = dimensions[i] > 0 ? above : below;
    side.push_back(power == 1 ? kNames[i] : fmt::format("{}^{}", kNames[i], power));
  }
  std::string text = above.empty() ? "1" : fmt::format("{}", fmt::join(above, " "));
  for (const std::string& part : below) text += "/" + part;
  return text;
}

std::string describe_units() {
  std::string text =
      "A number without a unit is in SI units and radians. With one it is a text: \"60 deg\",\n"
      "\"80 mm\", \"1e6 N/m\", \"3000 rpm\", \"5 lbf.in\". The unit is converted, and what it "
      "measures is\nchecked.\n\n"
      "    product   N m, N*m, N.m, N\u00B7m, N-m      a '/' divides by the next unit only: N s/m\n"
      "    power     m^2, m**2, m\u00B2, s^-1         bracket   J/(kg m)\n\n"
      "Angles are a dimension of their own: a speed of turn is rad/s, deg/s, rev/min or rpm, never "
      "Hz or\n1/s; a stiffness against turning is N m/rad.\n\n";
  text += fmt::format("    {:<6} {:>18}  {:<14} {}\n", "symbol", "is", "of", "name");
  for (const UnitSymbol& symbol : kSymbols) {
    text += fmt::format("    {:<6} {:>18.15g}  {:<14} {}{}\n", symbol.name, symbol.unit.factor,
                        dimension_text(symbol.unit.dimensions), symbol.meaning,
                        symbol.takes_prefix ? "; takes prefixes" : "");
  }
  text += "\nPrefixes:";
  for (const UnitPrefix& prefix : kPrefixes) {
    text += fmt::format(" {} {:g}{}", prefix.name, prefix.factor,
                        &prefix == std::end(kPrefixes) - 1 ? "\n" : ",");
  }
  return text;
}

}  // namespace linkstudy
