// Units that depend on a neighbour: coordinates and springs follow the joint's type, loads and
// drives on a joint follow the coordinate they act on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/topology/linkage.h"
#include "study/config/tree.h"

namespace linkstudy {

struct JointKind {
  JointType type = JointType::revolute;
  RotationCoordinates coordinates = RotationCoordinates::zyx;
  bool is_known = false;  // false: the type is absent or wrong
};

// The record of a list such as "joint" with this name, or nothing.
const Tree* find_named(const Tree& model, std::string_view list, const std::string& name);

JointKind joint_kind_of(const Tree& joint);

// One unit for each coordinate: "rad", "m" or "1" (quaternion); "rad/s" or "m/s".
std::vector<std::string> position_units(const JointKind& kind);
std::vector<std::string> velocity_units(const JointKind& kind);

// Unit of one position coordinate of a joint of the model, "rad", "m" or "1"; nothing when there is
// no such joint or coordinate.
std::optional<std::string> position_unit(const Tree& model, const std::string& joint,
                                         std::int64_t coordinate);

// Units of the arrays of a joint by the name of the array: position and velocity as above, and
// stiffness, damping, rest of its spring.
std::vector<std::string> coordinate_units(const JointKind& kind, std::string_view key);

// The start when none is written: zero, a unit quaternion where one is used.
Tree start_position(const JointKind& kind);

}  // namespace linkstudy
