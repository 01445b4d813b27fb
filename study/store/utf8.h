// Texts from anywhere (messages of exceptions, host names) made fit for files that promise UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace linkstudy {

// The text with U+FFFD for every byte that is no part of a UTF-8 sequence, and for NUL.
std::string valid_utf8(std::string_view text);

}  // namespace linkstudy
