// Where a walk through an input is; texts are made from it only when something is reported.
#pragma once

#include <string>
#include <string_view>

#include "study/config/tree.h"

namespace linkstudy {

struct Scope {
  const Scope* up = nullptr;
  std::string_view key = {};
  const Tree* element = nullptr;  // of an element of [[tables]]
  std::size_t index = 0;
};

// "link 'crank': mass", "joint 'A': frame.position", "simulation.step"; of an element "drive 0: ",
// of one in another "link 'crank': shape 0: ".
std::string subject_of(const Scope& scope);

// The same of a key below.
std::string subject_of(const Scope& scope, std::string_view key);

}  // namespace linkstudy
