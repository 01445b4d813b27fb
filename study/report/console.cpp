#include "study/report/console.h"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace linkstudy {
namespace {

bool wants_colours() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  if (is_set("NO_COLOR") || !is_set("TERM") || isatty(STDERR_FILENO) == 0) return false;
  return std::string_view(std::getenv("TERM")) != "dumb";
}

}  // namespace

void print_out(std::string_view text) {
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (is_written && std::fflush(stdout) == 0) return;
  const int error = errno;
  std::error_code ignored;
  const auto file = std::filesystem::read_symlink("/proc/self/fd/1", ignored);
  const std::string where = ignored ? std::string() : fmt::format(" ({})", file.string());
  throw OutputError(
      fmt::format("standard output cannot be written: {}{}", std::strerror(error), where));
}

void print_err(std::string_view text) {
  static const bool has_colours = wants_colours();
  fmt::print(stderr, "{}", has_colours ? coloured(text) : std::string(text));
}

std::string coloured(std::string_view text) {
  struct Word {
    std::string_view word;
    std::string_view colour;
  };
  constexpr Word words[] = {{"error:", "31"}, {"warning:", "35"}, {"note:", "36"}};
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    std::size_t at = std::string_view::npos;
    const Word* found = nullptr;
    for (const Word& word : words) {
      const std::size_t here = line.find(fmt::format(": {} ", word.word));
      if (here >= at) continue;
      at = here;
      found = &word;
    }
    if (found == nullptr) {
      result += line;
      continue;
    }
    const std::size_t begin = at + 2;
    result += fmt::format("{}\x1b[1;{}m{}\x1b[0m{}", line.substr(0, begin), found->colour,
                          found->word, line.substr(begin + found->word.size()));
  }
  return result;
}

void print_remarks(const std::vector<Diagnostic>& remarks) {
  for (const Diagnostic& remark : remarks) print_err(to_string(remark) + "\n");
}

}  // namespace linkstudy
