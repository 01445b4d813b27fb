// What a user can mend: wrong inputs, with everything that is wrong in them, and wrong usage. Exit
// code 2.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "study/config/diagnostic.h"

namespace linkstudy {

class InputError : public std::runtime_error {
 public:
  explicit InputError(Diagnostics diagnostics)
      : std::runtime_error(to_string(diagnostics)), diagnostics_(std::move(diagnostics)) {}
  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  Diagnostics diagnostics_;
};

inline void throw_if_any(const Diagnostics& diagnostics) {
  if (!diagnostics.empty()) throw InputError(diagnostics);
}

// Something typed wrong.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace linkstudy
