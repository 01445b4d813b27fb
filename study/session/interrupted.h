// How work that cannot go on for now ends; its own header, since references end so, too.
#pragma once

#include <stdexcept>

namespace linkstudy {

// A stop signal or the end of the wall time: everything is written, a later start continues.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace linkstudy
