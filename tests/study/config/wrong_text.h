// Damaged inputs: each gives exactly one error, at the marked place. In the replacement text @
// marks the place; it is removed before reading, its line and column are the expected ones.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "study/config/diagnostic.h"

namespace linkstudy::test {

struct Wrong {
  const char* what;
  const char* from;  // replaced in a right text ...
  const char* to;    // ... by this
  const char* message;
  const char* remedy = "";
};

void PrintTo(const Wrong& wrong, std::ostream* out);

void expect_one_error(const std::string& right, const Wrong& wrong);

// Of files with others beside them, whose message says the place.
struct WrongFile {
  const char* name;
  const char* before;  // replaced in a right text ...
  const char* after;   // ... by this
  const char* message;
};

// `reads`: whether the text is right, with what is wrong in it.
using ReadsText = std::function<bool(const std::string& text, Diagnostics& diagnostics)>;

void expect_one_message(const std::string& right, const WrongFile& wrong, const ReadsText& reads);

}  // namespace linkstudy::test
