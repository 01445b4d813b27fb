#include "study/report/write_table.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <stdexcept>

namespace linkstudy {
namespace {

constexpr std::size_t kFileWidth = 100;  // of a file or a pipe
constexpr std::size_t kLeastWidth = 20;

constexpr std::array<TableFormat, 5> kFormats = {{
    {"text", [](const Table& table, std::size_t width) { return text_of(table, width); }},
    {"csv", [](const Table& table, std::size_t) { return csv_of(table); }},
    {"md", [](const Table& table, std::size_t) { return markdown_of(table); }},
    {"latex", [](const Table& table, std::size_t) { return latex_of(table); }},
    {"json", [](const Table& table, std::size_t) { return json_of(table); }},
}};

}  // namespace

std::span<const TableFormat> table_formats() {
  return kFormats;
}

const TableFormat& table_format(std::string_view name) {
  std::string names;
  for (const TableFormat& format : kFormats) {
    if (format.name == name) return format;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  }
  throw std::invalid_argument(fmt::format("unknown format '{}'; choose one of {}", name, names));
}

std::size_t output_width() {
  if (const char* columns = std::getenv("COLUMNS")) {
    const std::string_view text = columns;
    std::size_t width = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), width);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    if (is_whole && width >= kLeastWidth) return width;
  }
  winsize size{};
  const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= kLeastWidth;
  return is_known ? size.ws_col : kFileWidth;
}

}  // namespace linkstudy
