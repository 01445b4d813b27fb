#include "study/config/unit.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

namespace linkstudy {
namespace {

struct Symbol {
  std::string_view name;
  bool takes_prefix;
  Unit unit;
};

struct Prefix {
  std::string_view name;
  double factor;
};

constexpr double kPi = std::numbers::pi;

// Dimensions: m, kg, s, rad.
constexpr Symbol kSymbols[] = {
    {"m", true, {1.0, {1, 0, 0, 0}}},
    {"g", true, {1.0e-3, {0, 1, 0, 0}}},
    {"s", true, {1.0, {0, 0, 1, 0}}},
    {"rad", true, {1.0, {0, 0, 0, 1}}},
    {"N", true, {1.0, {1, 1, -2, 0}}},
    {"J", true, {1.0, {2, 1, -2, 0}}},
    {"W", true, {1.0, {2, 1, -3, 0}}},
    {"Pa", true, {1.0, {-1, 1, -2, 0}}},
    {"Hz", true, {1.0, {0, 0, -1, 0}}},
    {"bar", true, {1.0e5, {-1, 1, -2, 0}}},
    {"t", true, {1.0e3, {0, 1, 0, 0}}},
    {"Nm", true, {1.0, {2, 1, -2, 0}}},
    {"deg", false, {kPi / 180.0, {0, 0, 0, 1}}},
    {"rev", false, {2.0 * kPi, {0, 0, 0, 1}}},
    {"rpm", false, {kPi / 30.0, {0, 0, -1, 1}}},
    {"min", false, {60.0, {0, 0, 1, 0}}},
    {"h", false, {3600.0, {0, 0, 1, 0}}},
    {"%", false, {0.01, {0, 0, 0, 0}}},
    {"\u00B0", false, {kPi / 180.0, {0, 0, 0, 1}}},
};

constexpr Prefix kPrefixes[] = {
    {"p", 1e-12}, {"n", 1e-9}, {"u", 1e-6}, {"\u00B5", 1e-6}, {"\u03BC", 1e-6},
    {"m", 1e-3},  {"c", 1e-2}, {"d", 1e-1}, {"da", 1e1},      {"h", 1e2},
    {"k", 1e3},   {"M", 1e6},  {"G", 1e9},  {"T", 1e12},
};

std::optional<Unit> find_symbol(std::string_view name) {
  for (const Symbol& symbol : kSymbols) {
    if (symbol.name == name) return symbol.unit;
  }
  for (const Prefix& prefix : kPrefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (const Symbol& symbol : kSymbols) {
      if (!symbol.takes_prefix || symbol.name != name.substr(prefix.name.size())) continue;
      return Unit{prefix.factor * symbol.unit.factor, symbol.unit.dimensions};
    }
  }
  return std::nullopt;
}

constexpr int kLargestPower = 9;
constexpr int kDeepestBracket = 16;

class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::optional<Unit> run() {
    std::optional<Unit> unit = product(0);
    if (unit && at_ < text_.size()) unit = fail(fmt::format("'{}'", text_.substr(at_)));
    return unit;
  }
  const std::string& fault() const { return fault_; }

 private:
  std::optional<Unit> fail(std::string fault) {
    if (fault_.empty()) fault_ = std::move(fault);
    return std::nullopt;
  }

  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  bool accept(std::string_view token) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }

  std::optional<Unit> product(int depth) {
    std::optional<Unit> left = factor(depth);
    while (left) {
      skip_blanks();
      if (at_ == text_.size() || text_[at_] == ')') break;
      const bool divides = accept("/");
      if (!divides && !accept("*")) accept("\u00B7");
      const std::optional<Unit> right = factor(depth);
      if (!right) return std::nullopt;
      left = combine(*left, *right, divides ? -1 : 1);
    }
    return left;
  }

  static Unit combine(const Unit& a, const Unit& b, int power) {
    Unit result = a;
    result.factor *= std::pow(b.factor, power);
    for (std::size_t i = 0; i < 4; ++i) result.dimensions[i] += power * b.dimensions[i];
    return result;
  }

  std::optional<Unit> factor(int depth) {
    const std::optional<Unit> base = accept("(") ? bracket(depth) : symbol();
    if (!base) return std::nullopt;
    const std::optional<int> exponent = power();
    if (!exponent) return fail(fmt::format("the power in '{}'", text_));
    return combine(Unit{}, *base, *exponent);
  }

  std::optional<Unit> bracket(int depth) {
    if (depth >= kDeepestBracket) return fail("too many brackets");
    const std::optional<Unit> inner = product(depth + 1);
    if (inner && !accept(")")) return fail("a bracket that is not closed");
    return inner;
  }

  std::optional<Unit> symbol() {
    skip_blanks();
    const std::size_t start = at_;
    if (accept("1")) return Unit{};
    const auto ends = [](std::string_view rest) {
      static constexpr std::string_view kMarks[] = {" ", "*",      "/",      "^",     "(",
                                                    ")", "\u00B7", "\u00B2", "\u00B3"};
      for (const std::string_view mark : kMarks) {
        if (rest.starts_with(mark)) return true;
      }
      return false;
    };
    while (at_ < text_.size() && !ends(text_.substr(at_))) ++at_;
    const std::string_view name = text_.substr(start, at_ - start);
    std::optional<Unit> unit = find_symbol(name);
    if (!unit) return fail(fmt::format("'{}'", name));
    return unit;
  }

  std::optional<int> power() {
    if (text_.substr(at_).starts_with("\u00B2")) return at_ += 2, 2;
    if (text_.substr(at_).starts_with("\u00B3")) return at_ += 2, 3;
    if (!text_.substr(at_).starts_with("^")) return 1;
    const char* begin = text_.data() + at_ + 1;
    int value = 0;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc() || std::abs(value) > kLargestPower) return std::nullopt;
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string fault_;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text, std::string* fault) {
  if (trimmed(text).empty()) return Unit{};
  UnitParser parser(trimmed(text));
  std::optional<Unit> unit = parser.run();
  if (!unit && fault != nullptr) *fault = parser.fault();
  return unit;
}

std::optional<WrittenQuantity> split_quantity(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  const std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
  return WrittenQuantity{value, std::string(trimmed(rest))};
}

std::optional<double> convert_unit(double value, const Unit& from, const Unit& to) {
  if (from.dimensions != to.dimensions) return std::nullopt;
  return from.factor == to.factor ? value : value * (from.factor / to.factor);
}

}  // namespace linkstudy
