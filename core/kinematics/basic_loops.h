// Basic loops: every closure makes one, of the joints on the two ways from its links back to the
// body where these meet. The closure is where the loop is cut ([Palcak] "Virtual cut").
#pragma once

#include <string>
#include <vector>

#include "core/model/mechanism.h"

namespace linkstudy {

struct BasicLoop {
  ClosureIndex closure;
  BodyIndex common;                          // where the two ways meet
  std::vector<VelocityIndex> first, second;  // on the ways from there, outwards
  std::vector<std::string> joints;  // round the loop: "joint.A", .., "closure.S", .., "joint.D"
};

// In the order of the closures.
std::vector<BasicLoop> find_basic_loops(const Mechanism& m);

}  // namespace linkstudy
