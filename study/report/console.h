// Standard output, checked: a full disk behind it is an error and not silence.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "study/config/diagnostic.h"

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

void print_remarks(const std::vector<Diagnostic>& remarks);

}  // namespace linkstudy
