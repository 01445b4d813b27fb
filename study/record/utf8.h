// Sequences of bytes that are a character in UTF-8.
#pragma once

#include <cstddef>
#include <string_view>

namespace linkstudy {

// Bytes of the character that a text begins with; 0 where it begins with none (overlong forms,
// surrogates and values above U+10FFFF included) or is empty.
std::size_t utf8_length(std::string_view text);

}  // namespace linkstudy
