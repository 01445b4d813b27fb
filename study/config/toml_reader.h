// TOML 1.0 text to a Tree; the only place that includes toml++. Problems become diagnostics with
// their place: missing, unreadable, empty or too large files, bytes that are not UTF-8, syntax
// errors, dates (which no key takes).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "study/config/tree.h"

namespace linkstudy {

inline constexpr std::size_t kLargestInput = std::size_t{16} << 20;  // bytes

std::optional<std::string> read_text_file(const std::string& path, Diagnostics& diagnostics);

// `file` is the name shown in diagnostics.
std::optional<Tree> parse_toml(std::string_view text, const std::string& file,
                               Diagnostics& diagnostics);

std::optional<Tree> read_toml_file(const std::string& path, Diagnostics& diagnostics);

}  // namespace linkstudy
