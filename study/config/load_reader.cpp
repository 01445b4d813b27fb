#include "study/config/load_reader.h"

#include <fmt/format.h>

#include <optional>

#include "study/config/frame_reader.h"
#include "study/config/joint_units.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

// "rad/s" or "m/s" of the coordinate a load acts on, when joint, type and coordinate are right.
std::optional<std::string> speed_unit(const Tree& model, const Load& load) {
  const Tree* joints = model.find("joint");
  if (joints == nullptr) return std::nullopt;
  for (const Tree& joint : joints->items) {
    if (word_of(joint, "name") != load.joint) continue;
    const JointKind kind = joint_kind_of(joint);
    const std::vector<std::string> units = velocity_units(kind);
    const auto index = static_cast<std::size_t>(load.coordinate);
    if (!kind.is_known || index >= units.size()) return std::nullopt;
    return units[index];
  }
  return std::nullopt;
}

class LoadReader {
 public:
  LoadReader(Tree& tree, const Tree& model, Diagnostics& diagnostics)
      : tree_(tree), model_(model), diagnostics_(diagnostics), subject_(title("load", tree)) {}

  Load read() {
    Load load;
    const std::string type = word_of(tree_, "type");
    load.name = word_of(tree_, "name");
    if (type == "resistance") load.type = LoadType::resistance;
    if (type == "link_force") load.type = LoadType::link_force;
    if (type == "link_torque") load.type = LoadType::link_torque;
    load.joint = word_of(tree_, "joint");
    load.coordinate = static_cast<int>(integer_of(tree_, "coordinate", 0));
    load.link = word_of(tree_, "link");
    load.point = read_vector(tree_.find("point"), Eigen::Vector3d::Zero());
    load.direction = read_direction(tree_.find("direction"), Eigen::Vector3d::UnitX(),
                                    subject_ + "direction", diagnostics_);
    load.follows_link = word_of(tree_, "axes") == "link";
    check_type(type, load);
    read_course(type, load);
    read_law(load);
    return load;
  }

 private:
  void check_type(const std::string& type, const Load& load) {
    const bool is_torque = type == "torque";
    if (!is_torque && type != "force") return;
    const std::optional<std::string> speed = speed_unit(model_, load);
    if (!speed || (*speed == "rad/s") == is_torque) return;
    Tree& value = *tree_.find("type");
    diagnostics_.add(value.at,
                     fmt::format("{}type {} does not fit coordinate {} of joint '{}', a {}, got "
                                 "'{}'",
                                 subject_, type, load.coordinate, load.joint,
                                 is_torque ? "translation" : "rotation", type),
                     fmt::format("use type = \"{}\"", is_torque ? "force" : "torque"));
  }

  void require_unit(Tree& value, const std::string& key, const std::string& unit) {
    if (value.is_valid() && !value.text.empty() && value.text != unit) {
      report_unit(value, subject_ + key, unit, diagnostics_);
    }
  }

  void read_course(const std::string& type, Load& load) {
    Tree* tree = tree_.find("course");
    if (tree == nullptr || !tree->is(Kind::table)) {
      load.course.shape = CourseShape::constant;
      return;
    }
    const std::string unit = type == "force" || type == "link_force" ? "N" : "N m";
    if (Tree* value = tree->find("value")) require_unit(*value, "course.value", unit);
    if (Tree* values = tree->find("values"); values != nullptr && values->is(Kind::array)) {
      for (Tree& value : values->items) require_unit(value, "course.values", unit);
    }
    const std::string shape = word_of(*tree, "shape");
    if (shape == "ramp") load.course.shape = CourseShape::ramp;
    if (shape == "smooth") load.course.shape = CourseShape::smooth;
    if (shape == "table") load.course.shape = CourseShape::table;
    load.course.value = number_of(*tree, "value", 0.0);
    load.course.duration = number_of(*tree, "duration", load.course.duration);
    load.course.times = numbers_of(*tree, "times");
    load.course.values = numbers_of(*tree, "values");
    const bool is_broken =
        shape == "table" && (!tree->find("times")->is_valid() || !tree->find("values")->is_valid());
    if (is_broken) load.course.shape = CourseShape::constant;
  }

  void read_law(Load& load) {
    Tree* tree = tree_.find("law");
    if (tree == nullptr || !tree->is(Kind::table)) return;
    const std::optional<std::string> speed = speed_unit(model_, load);
    if (speed) {
      const std::string force = *speed == "rad/s" ? "N m" : "N";
      if (Tree* value = tree->find("value")) require_unit(*value, "law.value", force);
      if (Tree* value = tree->find("at_speed")) require_unit(*value, "law.at_speed", *speed);
    }
    if (word_of(*tree, "shape") == "quadratic") load.law.shape = ResistanceShape::quadratic;
    load.law.value = number_of(*tree, "value", 0.0);
    load.law.at_speed = number_of(*tree, "at_speed", 1.0);
  }

  Tree& tree_;
  const Tree& model_;
  Diagnostics& diagnostics_;
  std::string subject_;
};

}  // namespace

Load read_load(Tree& load_table, const Tree& model, Diagnostics& diagnostics) {
  return LoadReader(load_table, model, diagnostics).read();
}

}  // namespace linkstudy
