// One thing a user can mend in a description: where (dotted path, e.g. "joint.A.parent"), what is
// wrong (thing and value), and what to do about it. The reader of the text turns the path into
// file:line:column.
#pragma once

#include <string>
#include <vector>

namespace linkstudy {

struct Problem {
  std::string path;
  std::string message;
  std::string remedy;
};

}  // namespace linkstudy
