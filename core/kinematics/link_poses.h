// Poses of all links in ground as shortened dual quaternions: Euler parameters of the orientation
// and the origin of the link frame ([Palcak] (4.14)).
#pragma once

#include <vector>

#include "core/model/compile.h"
#include "core/spatial/euler_parameters.h"

namespace linkstudy {

// In the order of Mechanism::link_names, ground first. `linkage` is the one that was compiled.
std::vector<ShortenedDualQuaternion> link_poses(const Linkage& linkage, const Model& model,
                                                const State<double>& s);

}  // namespace linkstudy
