#include "study/config/unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace linkstudy {
namespace {

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
  const UnitFault& fault() const { return fault_; }

 private:
  std::optional<Unit> fail(std::string part, std::string hint = {}) {
    if (fault_.part.empty()) fault_ = {std::move(part), std::move(hint)};
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
      if (!divides) accept_product();
      const std::optional<Unit> right = factor(depth);
      if (!right) return std::nullopt;
      left = combine(*left, *right, divides ? -1 : 1);
    }
    return left;
  }

  // At most one mark; two factors side by side are a product as well.
  void accept_product() {
    for (const std::string_view mark : {"*", ".", "\u00B7", "\u22C5"})
      if (accept(mark)) return;
    if (is_hyphen(at_)) ++at_;
  }

  bool is_hyphen(std::size_t at) const {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    return at > 0 && at + 1 < text_.size() && text_[at] == '-' && is_letter(text_[at - 1]) &&
           is_letter(text_[at + 1]);
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
    while (at_ < text_.size() && !ends_symbol()) ++at_;
    const std::string name(text_.substr(start, at_ - start));
    std::optional<Unit> unit = find_unit_symbol(name);
    if (!unit) return fail(fmt::format("'{}'", name), hint_for(name));
    return unit;
  }

  bool ends_symbol() const {
    static constexpr std::string_view kMarks[] = {" ", "*",      "/",      ".",      "^",     "(",
                                                  ")", "\u00B7", "\u22C5", "\u00B2", "\u00B3"};
    const std::string_view rest = text_.substr(at_);
    return is_hyphen(at_) || std::ranges::any_of(kMarks, [&](std::string_view mark) {
             return rest.starts_with(mark);
           });
  }

  // "s2" and "s-1" lack the mark of a power.
  static std::string hint_for(const std::string& name) {
    const std::size_t digits = name.find_first_of("-0123456789");
    if (digits != std::string::npos && digits > 0 && find_unit_symbol(name.substr(0, digits))) {
      return fmt::format("a power is written {}^{}", name.substr(0, digits), name.substr(digits));
    }
    const std::string near = nearest_unit(name);
    return near.empty() ? near : fmt::format("did you mean {}?", near);
  }

  std::optional<int> power() {
    if (text_.substr(at_).starts_with("\u00B2")) return at_ += 2, 2;
    if (text_.substr(at_).starts_with("\u00B3")) return at_ += 2, 3;
    const bool is_double = text_.substr(at_).starts_with("**");
    if (!is_double && !text_.substr(at_).starts_with("^")) return 1;
    const char* begin = text_.data() + at_ + (is_double ? 2 : 1);
    int value = 0;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc() || std::abs(value) > kLargestPower) return std::nullopt;
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  UnitFault fault_;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text, UnitFault* fault) {
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

std::string explain_angle(const Unit& from, const Unit& to) {
  std::array<int, 4> rest = to.dimensions;
  for (std::size_t i = 0; i < 4; ++i) rest[i] -= from.dimensions[i];
  const int angles = std::exchange(rest[3], 0);
  if (angles == 0 || rest != std::array<int, 4>{}) return {};
  constexpr std::array<int, 4> kRate = {0, 0, -1, 0};
  if (from.dimensions == kRate) return "a speed of turn is written rev/s, rpm, rad/s or deg/s";
  return fmt::format("angles are a dimension of their own: write it in {}",
                     dimension_text(to.dimensions));
}

}  // namespace linkstudy
