#include "study/report/table_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/record/lines.h"

namespace linkstudy {
namespace {

std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

}  // namespace

std::string shown(const Column& column, std::size_t row, const std::string& missing) {
  return std::visit(
      [&](const auto& values) -> std::string {
        const auto& value = values.at(row);
        using Kind = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Kind, std::string>) {
          return one_line(value);
        } else if constexpr (std::is_same_v<Kind, double>) {
          return std::isnan(value) ? missing : fmt::format(fmt::runtime(column.format), value);
        } else {
          const auto index = static_cast<std::size_t>(value);
          return index < column.words.size() ? column.words[index] : fmt::format("{}", value);
        }
      },
      column.values);
}

std::vector<std::string> wrapped(std::string_view name, std::size_t width) {
  std::vector<std::string> lines(1);
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of("._ "), name.size() - 1) + 1;
    const std::string_view piece = name.substr(0, end);
    name.remove_prefix(end);
    if (!lines.back().empty() && text_width(lines.back()) + text_width(piece) > width) {
      lines.emplace_back();
    }
    lines.back() += piece;
  }
  return lines;
}

}  // namespace linkstudy
