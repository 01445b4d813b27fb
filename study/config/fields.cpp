#include "study/config/fields.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace linkstudy {
namespace {

constexpr double kLeastPlain = 1.0e-3;  // smaller numbers are shown with a power of ten
constexpr double kMostPlain = 1.0e6;    // and so are these and larger ones

// "2.07e11", "1.0e-4"
std::string with_power(double value) {
  char buffer[32];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific);
  const std::string_view text(buffer, static_cast<std::size_t>(end.ptr - buffer));
  const std::size_t mark = text.find('e');
  const std::string digits(text.substr(0, mark));
  const int power = std::stoi(std::string(text.substr(mark + 1)));
  return fmt::format("{}{}e{}", digits, digits.find('.') == digits.npos ? ".0" : "", power);
}

}  // namespace

std::string standard_text(double value) {
  const double size = std::abs(value);
  const bool is_plain = size == 0.0 || (size >= kLeastPlain && size < kMostPlain);
  return is_plain ? number_text(value) : with_power(value);
}

std::string standard_text(const std::string& value) {
  return value.empty() ? value : "\"" + value + "\"";
}

std::string standard_text(const Eigen::Vector3d& value) {
  return fmt::format("[{}, {}, {}]", standard_text(value.x()), standard_text(value.y()),
                     standard_text(value.z()));
}

std::string standard_text(const Eigen::Matrix3d& value) {
  const auto row = [&](int i) { return standard_text(Eigen::Vector3d(value.row(i))); };
  return fmt::format("[{}, {}, {}]", row(0), row(1), row(2));
}

void fill_member(Eigen::Vector3d& member, const Tree& value) {
  for (int i = 0; i < 3; ++i) member[i] = value.items[static_cast<std::size_t>(i)].as_number();
}

void fill_member(Eigen::Matrix3d& member, const Tree& value) {
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d row;
    fill_member(row, value.items[static_cast<std::size_t>(i)]);
    member.row(i) = row.transpose();
  }
}

void fill_member(std::vector<double>& member, const Tree& value) {
  if (value.is_numeric()) member.push_back(value.as_number());
  for (const Tree& item : value.items) member.push_back(item.as_number());
}

std::string with_meanings(const std::string& meaning, const std::vector<WordMeaning>& words) {
  std::vector<std::string> parts;
  if (!meaning.empty()) parts.push_back(meaning);
  for (const auto& [text, own] : words) parts.push_back(fmt::format("{}: {}", text, own));
  return fmt::format("{}", fmt::join(parts, "; "));
}

void require_no_standard(const std::string& key, const KeyRow& row) {
  if (row.standard.empty()) return;
  throw std::logic_error("key table: the default of " + key + " is that of its member");
}

}  // namespace linkstudy
