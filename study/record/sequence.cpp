#include "study/record/sequence.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace linkstudy {
namespace {

void check_count(const char* kind, double from, double to, std::size_t count) {
  if (!std::isfinite(from) || !std::isfinite(to))
    throw std::invalid_argument(
        fmt::format("{}: ends must be finite numbers, got {} and {}", kind, from, to));
  if (count == 0 || (count == 1 && from != to))
    throw std::invalid_argument(fmt::format(
        "{}: {} value(s) cannot hold both ends {} and {}; use 2 or more", kind, count, from, to));
  if (count > kMaxPoints)
    throw std::invalid_argument(
        fmt::format("{}: {} values are more than the {} allowed", kind, count, kMaxPoints));
}

// The whole number of decades from one value to another, if it is one to the last bit.
std::optional<long> whole_decades(double from, double to) {
  const double ratio = std::log10(to) - std::log10(from);
  const long decades = std::lround(ratio);
  if (std::abs(ratio - static_cast<double>(decades)) > 1e-9) return std::nullopt;
  if (shift_decimal(from, decades) != to) return std::nullopt;
  return decades;
}

// One inner value of a log axis that spans whole decades: steps * decades / gaps is split into a
// whole part, shifted in decimal, and a rest.
double decade_value(double from, long decades, std::size_t step, std::size_t gaps) {
  const auto product = static_cast<long long>(step) * std::labs(decades);
  const auto divisor = static_cast<long long>(gaps);
  const long sign = decades < 0 ? -1 : 1;
  const double base = shift_decimal(from, sign * static_cast<long>(product / divisor));
  const double rest = static_cast<double>(product % divisor) / static_cast<double>(divisor);
  return rest == 0.0 ? base : base * std::pow(10.0, static_cast<double>(sign) * rest);
}

}  // namespace

double shift_decimal(double value, long decades) {
  if (!std::isfinite(value) || value == 0.0 || decades == 0) return value;
  std::array<char, 64> digits{};
  const auto printed = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                     std::chars_format::scientific);
  const std::string_view text(digits.data(), static_cast<std::size_t>(printed.ptr - digits.data()));
  const auto mark = text.find('e');
  const std::string exponent(text.substr(mark + (text[mark + 1] == '+' ? 2 : 1)));
  const std::string shifted =
      fmt::format("{}e{}", text.substr(0, mark), std::stol(exponent) + decades);
  double result = 0.0;
  const auto read = std::from_chars(shifted.data(), shifted.data() + shifted.size(), result);
  if (read.ec == std::errc::result_out_of_range)
    return std::copysign(decades > 0 ? std::numeric_limits<double>::infinity() : 0.0, value);
  return result;
}

std::vector<double> linspace(double from, double to, std::size_t count) {
  check_count("lin", from, to, count);
  std::vector<double> values(count, from);
  const auto gaps = static_cast<double>(count - 1);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const auto step = static_cast<double>(i);
    // Weighted ends: 0 .. 1 in eleven points gives the bits of 0.3, which 3 * 0.1 does not.
    const double weighted = (from * (gaps - step) + to * step) / gaps;
    values[i] =
        std::isfinite(weighted) ? weighted : from * ((gaps - step) / gaps) + to * (step / gaps);
  }
  values.back() = to;
  return values;
}

std::vector<double> logspace(double from, double to, std::size_t count) {
  check_count("log", from, to, count);
  if (from <= 0.0 || to <= 0.0)
    throw std::invalid_argument(
        fmt::format("log: ends must be positive, got {} and {}; use lin instead", from, to));
  std::vector<double> values(count, from);
  const std::size_t gaps = count - 1;
  const auto decades = whole_decades(from, to);
  const double span = std::log10(to) - std::log10(from);
  const double ratio = to / from;
  for (std::size_t i = 1; i < gaps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(gaps);
    if (decades)
      values[i] = decade_value(from, *decades, i, gaps);
    else if (std::isfinite(ratio) && ratio > 0.0)
      values[i] = from * std::pow(ratio, part);
    else
      values[i] = std::pow(10.0, std::log10(from) + span * part);
  }
  values.back() = to;
  return values;
}

std::vector<double> ladder(double from, double ratio, std::size_t levels) {
  if (!std::isfinite(from) || from == 0.0)
    throw std::invalid_argument(
        fmt::format("ladder: from must be a finite number other than 0, got {}", from));
  if (!std::isfinite(ratio) || ratio <= 0.0 || ratio == 1.0)
    throw std::invalid_argument(
        fmt::format("ladder: ratio must be positive and not 1, got {}", ratio));
  check_count("ladder", from, from, levels);
  const auto decades = whole_decades(1.0, ratio);
  std::vector<double> values(levels, from);
  for (std::size_t i = 1; i < levels; ++i) {
    values[i] = decades ? shift_decimal(from, *decades * static_cast<long>(i))
                        : from * std::pow(ratio, static_cast<double>(i));
    if (!std::isfinite(values[i]) || values[i] == 0.0)
      throw std::invalid_argument(
          fmt::format("ladder: level {} from {} by ratio {} is {}; use fewer levels", i, from,
                      ratio, values[i]));
  }
  return values;
}

}  // namespace linkstudy
