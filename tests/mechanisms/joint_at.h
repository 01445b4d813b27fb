// A tree joint in one line, for builders of linkages.
#pragma once

#include <string>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

// Axes of the parent, displaced along its x axis.
Frame along_x(double distance);

// `frame`: joint frame in the parent; the joint frame in the child is the child's own.
Joint joint_at(const std::string& name, JointType type, const std::string& parent,
               const std::string& child, const Frame& frame);

// A revolute joint that starts at `angle` [rad] with `rate` [rad/s].
Joint pivot_at(const std::string& name, const std::string& parent, const std::string& child,
               const Frame& frame, double angle, double rate);

}  // namespace linkstudy::testing
