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

// The enumerator whose position in `words` of the row equals that of the text.
std::optional<std::size_t> word_index(const std::vector<std::string>& words,
                                      const std::string& text);

std::optional<JointType> joint_type_of(const std::string& word);

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

// The unit of the value at `path`, where its row leaves a choice; of an array, of its first entry.
// `model` may be validated or not. Nothing when the neighbours do not tell.
std::optional<std::string> unit_of_path(const Tree& model, const std::string& unit,
                                        const std::string& path);

}  // namespace linkstudy
