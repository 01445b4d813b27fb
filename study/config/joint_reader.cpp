#include "study/config/joint_reader.h"

#include <fmt/format.h>

#include <numbers>

#include "study/config/frame_reader.h"
#include "study/config/friction_reader.h"
#include "study/config/joint_units.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

class JointReader {
 public:
  JointReader(Tree& tree, Diagnostics& diagnostics)
      : tree_(tree),
        diagnostics_(diagnostics),
        kind_(joint_kind_of(tree)),
        subject_(title("joint", tree)) {}

  Joint read() {
    joint_.name = word_of(tree_, "name");
    joint_.type = kind_.type;
    joint_.coordinates = kind_.coordinates;
    joint_.parent = word_of(tree_, "parent");
    joint_.child = word_of(tree_, "child");
    joint_.frame = read_pose("frame");
    joint_.child_frame = read_pose("child_frame");
    // Written in m per revolution, kept in m/rad.
    const bool is_screw = joint_.type == JointType::screw;
    if (is_screw) joint_.pitch = number_of(tree_, "pitch", 1.0) / (2.0 * std::numbers::pi);
    read_start();
    read_spring();
    read_friction_table();
    return std::move(joint_);
  }

 private:
  Frame read_pose(const char* key) {
    const Tree* frame = tree_.find(key);
    if (frame == nullptr) return {};
    return read_frame(*frame, subject_ + key + ": ", diagnostics_);
  }

  Tree* find_table(const char* key) {
    Tree* table = tree_.find(key);
    return table != nullptr && table->is(Kind::table) ? table : nullptr;
  }

  void read_start() {
    Tree* initial = find_table("initial");
    if (initial == nullptr) return;
    joint_.hold = flag_of(*initial, "hold");
    if (!kind_.is_known) return;
    if (initial->find("position") == nullptr) {
      relocate(initial->set("position", start_position(kind_)), initial->at);
    }
    joint_.position = read_array(*initial, "initial", "position");
    joint_.velocity = read_array(*initial, "initial", "velocity");
    const bool has_quaternion =
        position_count(kind_.type, kind_.coordinates) != velocity_count(kind_.type);
    if (has_quaternion) normalise_quaternion(*initial);
  }

  void read_spring() {
    Tree* spring = find_table("spring");
    if (spring == nullptr || !kind_.is_known) return;
    joint_.stiffness = read_array(*spring, "spring", "stiffness");
    joint_.damping = read_array(*spring, "spring", "damping");
    joint_.rest = read_array(*spring, "spring", "rest");
  }

  void read_friction_table() {
    const Tree* table = find_table("friction");
    if (table == nullptr) return;
    const std::optional<Friction> law = read_friction(*table);
    if (!law) return;
    joint_.friction =
        JointFriction{*law, number_of(*table, "radius", 0.0), number_of(*table, "length", 0.0),
                      number_of(*table, "preload", 0.0)};
  }

  // Zeros where nothing is written, so that resolved.toml says so.
  std::vector<double> read_array(Tree& table, const std::string& owner, const char* key) {
    const std::vector<std::string> units = coordinate_units(kind_, key);
    if (table.find(key) == nullptr) {
      const Tree none(Tree::make_array(std::vector<Tree>(units.size(), Tree::make_number(0.0))));
      relocate(table.set(key, none), table.at);
    }
    return read_values(*table.find(key), units, subject_ + owner + "." + key);
  }

  std::vector<double> read_values(Tree& list, const std::vector<std::string>& units,
                                  const std::string& subject) {
    std::vector<double> values;
    if (!list.is(Kind::array)) return values;
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      Tree& item = list.items[i];
      values.push_back(item.as_number());
      if (i >= units.size() || item.text.empty() || item.text == units[i]) continue;
      report_unit(item, fmt::format("{}.{}", subject, i), units[i], diagnostics_);
      list.kind = Kind::invalid;
      return {};
    }
    return values;
  }

  void normalise_quaternion(Tree& initial) {
    const auto count = static_cast<std::size_t>(position_count(joint_.type, joint_.coordinates));
    if (joint_.position.size() != count) return;
    Eigen::Map<Eigen::Vector4d> q(joint_.position.data() + count - 4);
    if (std::abs(q.norm() - 1.0) <= kQuaternionTolerance) {
      q.normalize();
      return;
    }
    Tree& list = *initial.find("position");
    diagnostics_.add(list.at,
                     fmt::format("{}the quaternion in initial.position must have length 1, got "
                                 "length {:.6g}",
                                 subject_, q.norm()),
                     "order w, x, y, z; divide by the length");
    list.kind = Kind::invalid;
  }

  Tree& tree_;
  Diagnostics& diagnostics_;
  JointKind kind_;
  std::string subject_;
  Joint joint_;
};

}  // namespace

Joint read_joint(Tree& joint_table, Diagnostics& diagnostics) {
  return JointReader(joint_table, diagnostics).read();
}

}  // namespace linkstudy
