// Joints that hold what the rest of the linkage holds already. A joint carries redundant
// constraints where releasing all its constraints frees fewer motions than it has constraints:
//   tree joint   rank [J, T] - rank J, T the closure rates by the 6 twists of the joint's child
//   closure      rows of the closure less (rank J - rank J without them)
#pragma once

#include <string>
#include <vector>

#include "core/kinematics/scaled_closures.h"

namespace linkstudy {

struct CarriedRedundancy {
  std::string joint;  // "joint.NAME" or "closure.NAME"
  int count = 0;      // constraints of the joint that the rest of the linkage holds already
};

// Joints with a count above zero at a closed pose, tree joints first.
std::vector<CarriedRedundancy> find_redundant_joints(const Model& closed, const ClosureScale& scale,
                                                     const State<double>& pose);

}  // namespace linkstudy
