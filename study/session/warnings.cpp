#include "study/session/warnings.h"

#include <fmt/format.h>

#include <cctype>

#include "study/report/console.h"

namespace linkstudy {
namespace {

// Numbers begin with a digit, a sign or a point; names keep their digits: "joint.B2".
std::string without_numbers(const std::string& text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto digit_at = [&](std::size_t at) {
      return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
    };
    const bool begins = i == 0 || text[i - 1] == ' ' || text[i - 1] == '(' || text[i - 1] == '[';
    const bool is_number = begins && (digit_at(i) || (text[i] == '-' && digit_at(i + 1)));
    if (!is_number) {
      kept += text[i];
      continue;
    }
    kept += '#';
    while (i + 1 < text.size() && text.find_first_of(" ,;:)]", i + 1) != i + 1) ++i;
  }
  return kept;
}

}  // namespace

bool Warnings::add(const std::string& text) {
  Kind& kind = kinds_[without_numbers(text)];
  if (kind.count == 0) kind.first = text;
  return ++kind.count == 1;
}

void Warnings::log_counts(spdlog::logger& log) const {
  for (const auto& [text, kind] : kinds_) {
    if (kind.count > 1) log.warn("{} evaluations like this: {}", kind.count, kind.first);
  }
}

void say_warning(const std::string& text, spdlog::logger& log) {
  print_err(fmt::format("linkstudy: warning: {}\n", text));
  log.warn("{}", text);
}

}  // namespace linkstudy
