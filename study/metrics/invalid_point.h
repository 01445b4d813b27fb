// A point of a study that cannot be evaluated as it stands: recorded as Cause::invalid_point.
#pragma once

#include <stdexcept>

namespace linkstudy {

class InvalidPoint : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace linkstudy
