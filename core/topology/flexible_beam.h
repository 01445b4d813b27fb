// Axes of a flexible beam and names of the parts that it is divided into.
#pragma once

#include <string>

#include "core/topology/linkage.h"

namespace linkstudy {

inline constexpr int kMostSegments = 200;  // dense matrices of 3 freedoms a segment

// Columns are the axes of the beam in the link frame: x along the beam, y = `across` made
// perpendicular. Begin and end differ, across is not along the beam.
Eigen::Matrix3d beam_axes(const FlexibleBeam& beam);

// Elements <link>_rfe0 .. <link>_rfe<n>, and the joint <link>_sde<k> between elements k - 1 and k,
// k = 1 .. n.
std::string element_name(const std::string& link, int element);
std::string element_joint_name(const std::string& link, int joint);

}  // namespace linkstudy
