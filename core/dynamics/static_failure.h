// Why a linkage has no static equilibrium near a pose: the pose of least unbalance is sought by
// Levenberg and Marquardt, and what misses balance there told in words. There the force that is
// left meets no stiffness: either there never was any, or the springs have borne what they can (a
// limit load: snap-through, or the largest moment of a measure that is a sine).
#pragma once

#include <string>
#include <vector>

#include "core/model/compile.h"
#include "core/model/workspace.h"

namespace linkstudy {

std::string describe_unbalance(const Model& model, const State<double>& start,
                               const std::vector<int>& free, Workspace<double>& w);

}  // namespace linkstudy
