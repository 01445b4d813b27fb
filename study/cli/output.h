// Standard output, checked: a full disk behind it is an error and not silence.
#pragma once

#include <string>
#include <string_view>

namespace linkstudy {

// Throws std::runtime_error where it cannot be written.
void print_out(std::string_view text);

// A file of --csv that cannot be written is found before the run: throws UsageError.
void require_writable(const std::string& path);

// "LABEL   VALUE\n", aligned.
std::string summary_line(std::string_view label, std::string_view value);

}  // namespace linkstudy
