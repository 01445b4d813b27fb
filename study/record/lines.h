// Words in lines that fit a page of text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace linkstudy {

inline constexpr std::size_t kPageWidth = 100;  // columns

// Broken at spaces, none at the ends of lines; a word that is longer than `width` has a line of its
// own. Characters are counted, not bytes.
std::vector<std::string> words_in_lines(std::string_view text, std::size_t width);

// Columns of a text on a terminal.
std::size_t text_width(std::string_view text);

}  // namespace linkstudy
