#include "study/config/joint_units.h"

#include <algorithm>

#include "core/topology/linkage_words.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

// r: rotation, m: translation; one letter a velocity.
std::string motions(JointType type) {
  switch (type) {
    case JointType::revolute:
    case JointType::screw:
      return "r";
    case JointType::prismatic:
      return "m";
    case JointType::cylindrical:
      return "rm";
    case JointType::universal:
      return "rr";
    case JointType::spherical:
      return "rrr";
    case JointType::planar:
      return "mmr";
    case JointType::free:
      return "mmmrrr";
    case JointType::fixed:
    case JointType::pin_in_slot:
    case JointType::rod:
      return "";
  }
  return "";
}

}  // namespace

const Tree* find_named(const Tree& model, std::string_view list, const std::string& name) {
  const Tree* records = model.find(list);
  if (records == nullptr) return nullptr;
  for (const Tree& record : records->items) {
    const Tree* own = record.find("name");
    if (own != nullptr && own->text == name) return &record;
  }
  return nullptr;
}

JointKind joint_kind_of(const Tree& joint) {
  const std::optional<JointType> type = find_word<JointType>(word_of(joint, "type"));
  const std::optional<RotationCoordinates> coordinates =
      find_word<RotationCoordinates>(word_of(joint, "coordinates"));
  JointKind kind;
  kind.is_known = type.has_value();
  kind.type = type.value_or(kind.type);
  kind.coordinates = coordinates.value_or(kind.coordinates);
  return kind;
}

std::vector<std::string> position_units(const JointKind& kind) {
  std::vector<std::string> units;
  for (const char motion : motions(kind.type)) units.push_back(motion == 'r' ? "rad" : "m");
  const int count = position_count(kind.type, kind.coordinates);
  if (count == velocity_count(kind.type)) return units;
  units.resize(units.size() - 3);
  units.insert(units.end(), 4, "1");
  return units;
}

std::optional<std::string> position_unit(const Tree& model, const std::string& joint,
                                         std::int64_t coordinate) {
  const Tree* record = find_named(model, "joint", joint);
  if (record == nullptr || coordinate < 0) return std::nullopt;
  const JointKind kind = joint_kind_of(*record);
  const std::vector<std::string> units = position_units(kind);
  const auto index = static_cast<std::size_t>(coordinate);
  if (!kind.is_known || index >= units.size()) return std::nullopt;
  return units[index];
}

std::vector<std::string> velocity_units(const JointKind& kind) {
  std::vector<std::string> units;
  for (const char motion : motions(kind.type)) units.push_back(motion == 'r' ? "rad/s" : "m/s");
  return units;
}

std::vector<std::string> coordinate_units(const JointKind& kind, std::string_view key) {
  if (key == "position") return position_units(kind);
  if (key == "velocity") return velocity_units(kind);
  std::vector<std::string> units;
  for (const char motion : motions(kind.type)) {
    const bool turns = motion == 'r';
    if (key == "stiffness") units.push_back(turns ? "N m/rad" : "N/m");
    if (key == "damping") units.push_back(turns ? "N m s/rad" : "N s/m");
    if (key == "rest") units.push_back(turns ? "rad" : "m");
  }
  return units;
}

Tree start_position(const JointKind& kind) {
  const std::vector<std::string> units = position_units(kind);
  Tree start = Tree::make_array(std::vector<Tree>(units.size(), Tree::make_number(0.0)));
  const auto w = std::find(units.begin(), units.end(), "1");
  if (w != units.end()) start.items[static_cast<std::size_t>(w - units.begin())].number = 1.0;
  return start;
}

}  // namespace linkstudy
