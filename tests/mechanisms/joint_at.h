// A tree joint in one line, for builders of linkages.
#pragma once

#include <string>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

// `frame`: joint frame in the parent; the joint frame in the child is the child's own.
Joint joint_at(const std::string& name, JointType type, const std::string& parent,
               const std::string& child, const Frame& frame);

}  // namespace linkstudy::testing
