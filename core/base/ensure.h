// What only our own code can break: held in Release, too. What a user can mend is checked where it
// is read, and said with its place.
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>

namespace linkstudy {

// Throws std::logic_error, an internal error (exit code 1).
inline void ensure(bool holds, const char* what,
                   std::source_location at = std::source_location::current()) {
  if (!holds) throw std::logic_error(std::string(at.function_name()) + ": not so: " + what);
}

}  // namespace linkstudy
