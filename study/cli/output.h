// Standard output, checked: a full disk behind it is an error and not silence.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace linkstudy {

class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws OutputError where it cannot be written.
void print_out(std::string_view text);

// Standard error; the words error, warning and note of its lines are coloured on a terminal, unless
// NO_COLOR is set (no-color.org) or the terminal is dumb.
void print_err(std::string_view text);

// ": error: " and the like at the head of lines in colour.
std::string coloured(std::string_view text);

// A file of --csv that cannot be written is found before the run: throws UsageError.
void require_writable(const std::string& path);

// What an earlier run wrote there must not pass for that of one that fails now. "-" and what is no
// regular file are left alone.
void remove_old(const std::optional<std::string>& path);

// "LABEL   VALUE\n", aligned.
std::string summary_line(std::string_view label, std::string_view value);

}  // namespace linkstudy
