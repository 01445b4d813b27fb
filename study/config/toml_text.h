// What a text must be before it is parsed: UTF-8, and of bounded depth. Parsing, and all that walks
// what was parsed, goes down by recursion: "a.a.a. ..." of a megabyte would exhaust the stack.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "study/config/diagnostic.h"

namespace linkstudy {

// Keys of an input are at most five levels deep.
inline constexpr int kDeepestKey = 64;    // names of one dotted key or table header
inline constexpr int kDeepestValue = 64;  // brackets and braces within one another

// Says the first fault and where it is. Strings and comments may hold anything; behind the first
// fault of syntax, which is the parser's to say, nothing is judged rightly.
bool check_toml_text(std::string_view text, const std::shared_ptr<const std::string>& file,
                     Diagnostics& diagnostics);

}  // namespace linkstudy
