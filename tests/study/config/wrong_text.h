// Damaged inputs: each gives exactly one error, at the marked place. In the replacement text @
// marks the place; it is removed before reading, its line and column are the expected ones.
#pragma once

#include <iosfwd>
#include <string>

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

}  // namespace linkstudy::test
