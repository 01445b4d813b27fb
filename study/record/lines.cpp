#include "study/record/lines.h"

#include <algorithm>

namespace linkstudy {

std::size_t text_width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

std::vector<std::string> words_in_lines(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  std::size_t begin = 0;  // of what is no line yet, spaces in front of a word included
  while (begin < text.size()) {
    const std::size_t word = std::min(text.find_first_not_of(' ', begin), text.size());
    const std::size_t end = std::min(text.find(' ', word), text.size());
    const std::string_view spaced = text.substr(begin, end - begin);
    const bool fits = text_width(lines.back()) + text_width(spaced) <= width;
    if (fits || lines.back().empty()) {
      lines.back() += spaced;
    } else if (word < text.size()) {
      lines.emplace_back(text.substr(word, end - word));
    }
    begin = end;
  }
  return lines;
}

}  // namespace linkstudy
