// Idle freedoms: motions that the rest of the linkage does not notice. One link, or several in a
// row as one body, moves while all others rest: a coupler that spins about the line through its two
// ball joints, a leg of two links between ball joints on ground and on a platform. Links between
// ground and ground only, and ends of open chains, are never idle.
//
// With the twist of link b about the ground's origin V_b = S_b y, y in the null space N of the
// closure Jacobian: motions with V_c = 0 for all links c but the idle ones, whose twists are equal.
#pragma once

#include <string>
#include <vector>

#include "core/kinematics/scaled_closures.h"

namespace linkstudy {

struct IdleFreedom {
  std::vector<std::string> links;   // 1, or more that move as one
  std::vector<std::string> joints;  // at their ends: "joint.NAME", "closure.NAME"
  int count = 1;                    // independent ones of these links
};

// Those of first order at a closed pose.
std::vector<IdleFreedom> find_idle_freedoms(const Model& closed, const ClosureScale& scale,
                                            const State<double>& pose);

}  // namespace linkstudy
