#include "study/config/joint_units.h"

#include <algorithm>
#include <charconv>

#include "study/config/key.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

const std::vector<std::string>& words_of(std::string_view path) {
  const KeyNode* node = &model_schema();
  for (const std::string& part : split_path(path)) node = node->find(part);
  return node->row.words;
}

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
      return "";
  }
  return "";
}

const Tree* find_named(const Tree& model, std::string_view list, const std::string& name) {
  const Tree* records = model.find(list);
  if (records == nullptr) return nullptr;
  for (const Tree& record : records->items) {
    const Tree* own = record.find("name");
    if (own != nullptr && own->text == name) return &record;
  }
  return nullptr;
}

std::size_t last_index(const std::vector<std::string>& parts) {
  std::size_t index = 0;
  std::from_chars(parts.back().data(), parts.back().data() + parts.back().size(), index);
  return index;
}

std::optional<std::string> unit_of_coordinate(const Tree& model,
                                              const std::vector<std::string>& parts) {
  const Tree* joint = find_named(model, "joint", parts[1]);
  if (joint == nullptr || parts.size() < 4) return std::nullopt;
  const JointKind kind = joint_kind_of(*joint);
  if (!kind.is_known) return std::nullopt;
  const std::vector<std::string> units = coordinate_units(kind, parts[3]);
  const std::size_t index = parts.size() > 4 ? last_index(parts) : 0;
  if (index >= units.size()) return std::nullopt;
  return units[index];
}

std::optional<std::string> unit_of_load(const Tree& model, const std::vector<std::string>& parts) {
  const Tree* load = find_named(model, "load", parts[1]);
  const Tree* type = load != nullptr ? load->find("type") : nullptr;
  if (type == nullptr) return std::nullopt;
  if (type->text == "torque" || type->text == "link_torque") return "N m";
  if (type->text == "force" || type->text == "link_force") return "N";
  const Tree* name = load->find("joint");
  const Tree* joint = name != nullptr ? find_named(model, "joint", name->text) : nullptr;
  if (joint == nullptr) return std::nullopt;
  const std::vector<std::string> speeds = velocity_units(joint_kind_of(*joint));
  const Tree* coordinate = load->find("coordinate");
  const double index = coordinate != nullptr ? coordinate->as_number() : 0.0;
  if (!(index >= 0.0 && index < static_cast<double>(speeds.size()))) return std::nullopt;
  const std::string& speed = speeds[static_cast<std::size_t>(index)];
  if (parts.back() == "at_speed") return speed;
  return speed == "rad/s" ? "N m" : "N";
}

// "kinematics.drive.0.to"
std::optional<std::string> unit_of_drive(const Tree& model, const std::vector<std::string>& parts) {
  const Tree* kinematics = model.find("kinematics");
  const Tree* drives = kinematics != nullptr ? kinematics->find("drive") : nullptr;
  if (drives == nullptr || parts.size() < 4) return std::nullopt;
  const std::size_t index = last_index({parts[2]});
  if (index >= drives->items.size()) return std::nullopt;
  const Tree& drive = drives->items[index];
  return position_unit(model, word_of(drive, "joint"), integer_of(drive, "coordinate", 0));
}

}  // namespace

std::optional<std::size_t> word_index(const std::vector<std::string>& words,
                                      const std::string& text) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) return std::nullopt;
  return static_cast<std::size_t>(found - words.begin());
}

std::optional<JointType> joint_type_of(const std::string& word) {
  static const std::vector<std::string>& words = words_of("joint.*.type");
  const std::optional<std::size_t> index = word_index(words, word);
  if (!index) return std::nullopt;
  return static_cast<JointType>(*index);
}

JointKind joint_kind_of(const Tree& joint) {
  JointKind kind;
  const Tree* type = joint.find("type");
  const Tree* coordinates = joint.find("coordinates");
  const std::optional<JointType> known =
      type != nullptr && type->is(Tree::Kind::text) ? joint_type_of(type->text) : std::nullopt;
  kind.is_known = known.has_value();
  kind.type = known.value_or(JointType::revolute);
  const bool quaternion = coordinates != nullptr && coordinates->text == "quaternion";
  if (quaternion) kind.coordinates = RotationCoordinates::quaternion;
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

std::optional<std::string> unit_of_path(const Tree& model, const std::string& unit,
                                        const std::string& path) {
  if (unit.find('|') == std::string::npos) return unit;
  const std::vector<std::string> parts = split_path(path);
  if (parts.size() < 3) return std::nullopt;
  if (parts[0] == "kinematics") return unit_of_drive(model, parts);
  return parts[0] == "joint" ? unit_of_coordinate(model, parts) : unit_of_load(model, parts);
}

}  // namespace linkstudy
