// What can go wrong with a results directory and a user can mend: a full disk, a directory in use,
// results of another input. The message names the file, what happened and the remedy.
#pragma once

#include <stdexcept>

namespace linkstudy {

class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace linkstudy
