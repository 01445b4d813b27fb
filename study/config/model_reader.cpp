#include "study/config/model_reader.h"

#include <fmt/format.h>

#include <charconv>

#include "core/topology/check_linkage.h"
#include "study/config/clearance_reader.h"
#include "study/config/flexible_reader.h"
#include "study/config/frame_reader.h"
#include "study/config/joint_reader.h"
#include "study/config/joint_units.h"
#include "study/config/key.h"
#include "study/config/kinematics_reader.h"
#include "study/config/load_reader.h"
#include "study/config/read_value.h"
#include "study/config/sde_reader.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d read_inertia(const Tree& value) {
  std::array<double, 6> m{};
  for (std::size_t i = 0; i < value.items.size(); ++i) m[i] = value.items[i].as_number();
  Matrix3d inertia;
  inertia << m[0], m[3], m[4],  //
      m[3], m[1], m[5],         //
      m[4], m[5], m[2];
  return inertia;
}

Link read_link(Tree& tree, Diagnostics& diagnostics) {
  Link link;
  link.name = word_of(tree, "name");
  link.mass = number_of(tree, "mass", 1.0);
  link.center_of_mass = read_vector(tree.find("center_of_mass"), Vector3d::Zero());
  link.inertia = Matrix3d::Identity();
  const Tree* central = tree.find("inertia");
  const Tree* at_origin = tree.find("inertia_at_origin");
  if (central != nullptr && central->is(Kind::array)) link.inertia = read_inertia(*central);
  if (at_origin != nullptr && at_origin->is(Kind::array)) {
    // Parallel axis: I_C = I_O - m (c.c E - c c^T).
    const Vector3d& c = link.center_of_mass;
    link.inertia = read_inertia(*at_origin) -
                   link.mass * (c.squaredNorm() * Matrix3d::Identity() - c * c.transpose());
    const bool mass_is_known = tree.find("mass")->is_valid();
    const bool centre_is_known = tree.find("center_of_mass")->is_valid();
    if (!mass_is_known || !centre_is_known) link.inertia = Matrix3d::Identity();
  }
  link.flexible = read_flexible(tree, diagnostics);
  return link;
}

ChosenPoint read_point(const Tree& tree) {
  return {word_of(tree, "name"), word_of(tree, "link"),
          read_vector(tree.find("position"), Vector3d::Zero())};
}

class ModelReader {
 public:
  ModelReader(Tree& model, Diagnostics& diagnostics) : model_(model), diagnostics_(diagnostics) {}

  Linkage read() {
    Linkage linkage;
    linkage.name = word_of(model_, "name");
    linkage.gravity = read_vector(model_.find("gravity"), Vector3d::Zero());
    for_each("link", [&](Tree& tree) { linkage.links.push_back(read_link(tree, diagnostics_)); });
    for_each("joint",
             [&](Tree& tree) { linkage.joints.push_back(read_joint(tree, diagnostics_)); });
    for_each("closure", [&](Tree& tree) { linkage.closures.push_back(read_closure(tree)); });
    for_each("load",
             [&](Tree& tree) { linkage.loads.push_back(read_load(tree, model_, diagnostics_)); });
    for_each("point", [&](Tree& tree) { linkage.points.push_back(read_point(tree)); });
    return linkage;
  }

 private:
  template <class Action>
  void for_each(const char* list, Action action) {
    Tree* records = model_.find(list);
    if (records == nullptr) return;
    for (Tree& record : records->items) {
      // A record that is no table keeps its position for the paths of check().
      if (!record.is(Kind::table)) record = Tree{};
      action(record);
    }
  }

  ClosureEnd read_end(const Tree& closure, const char* key, const std::string& subject) {
    ClosureEnd end;
    const Tree* tree = closure.find(key);
    if (tree == nullptr || !tree->is(Kind::table)) return end;
    end.link = word_of(*tree, "link");
    end.frame = read_frame(*tree, subject + key + ": ", diagnostics_);
    return end;
  }

  Closure read_closure(Tree& tree) {
    Closure closure;
    const std::string subject = title("closure", tree);
    closure.name = word_of(tree, "name");
    closure.type = joint_type_of(word_of(tree, "type")).value_or(JointType::spherical);
    closure.first = read_end(tree, "first", subject);
    closure.second = read_end(tree, "second", subject);
    const std::string model = word_of(tree, "model");
    if (model == "sde") closure.model = ClosureModel::sde;
    if (model == "clearance") closure.model = ClosureModel::clearance;
    const Tree* cut = tree.find("cut");
    if (cut != nullptr && cut->is(Kind::table)) {
      const std::string word = word_of(*cut, "stabilization");
      if (word == "baumgarte") closure.stabilization = Stabilization::baumgarte;
      if (word == "projection") closure.stabilization = Stabilization::projection;
      closure.alpha = number_of(*cut, "alpha", closure.alpha);
      closure.beta = number_of(*cut, "beta", closure.beta);
    }
    read_sde(tree, closure, diagnostics_);
    read_clearance(tree, closure, diagnostics_);
    return closure;
  }

  Tree& model_;
  Diagnostics& diagnostics_;
};

SimulationOptions read_options(Tree& model, Diagnostics& diagnostics) {
  SimulationOptions options;
  Tree* tree = model.find("simulation");
  if (tree == nullptr || !tree->is(Kind::table)) return options;
  options.end_time = number_of(*tree, "end_time", options.end_time);
  options.step = number_of(*tree, "step", options.step);
  options.output_interval = number_of(*tree, "output_interval", options.output_interval);
  options.drift_limit = number_of(*tree, "drift_limit", options.drift_limit);
  options.statics_time = number_of(*tree, "statics_time", options.statics_time);
  if (word_of(*tree, "start") == "equilibrium") options.start = Start::equilibrium;
  if (word_of(*tree, "redundant_reactions") == "loops") {
    options.redundant_reactions = RedundantReactions::loops;
  }
  const std::string integrator = word_of(*tree, "integrator");
  if (integrator == "adaptive") options.integrator = Integrator::adaptive;
  if (integrator == "stiff") options.integrator = Integrator::stiff;
  if (const Tree* tolerance = tree->find("tolerance"); tolerance != nullptr) {
    options.relative_tolerance = number_of(*tolerance, "relative", options.relative_tolerance);
    options.absolute_tolerance = number_of(*tolerance, "absolute", options.absolute_tolerance);
  }
  options.step_limit = integer_of(*tree, "step_limit", options.step_limit);
  const bool both_known = tree->find("step")->is_valid() && tree->find("end_time")->is_valid();
  if (both_known && options.step > options.end_time) {
    diagnostics.add(tree->find("step")->at,
                    fmt::format("simulation.step must not exceed end_time = {:.9g} s, got {:.9g} s",
                                options.end_time, options.step),
                    "choose a smaller step or a later end");
  }
  return options;
}

// What check() says about connections is only as good as the names and types it was given.
bool structure_is_known(const Tree& model) {
  const auto all_known = [&](const char* list, std::initializer_list<const char*> keys) {
    const Tree* records = model.find(list);
    if (records == nullptr || !records->is(Kind::array)) return false;
    for (const Tree& record : records->items) {
      for (const char* key : keys) {
        const Tree* value = record.find(key);
        if (value == nullptr || !value->is_valid()) return false;
      }
    }
    return true;
  };
  return all_known("link", {"name"}) && all_known("joint", {"name", "type", "parent", "child"});
}

bool is_about_connections(const std::string& path) {
  const std::vector<std::string> parts = split_path(path);
  const std::string& last = parts.back();
  return parts.size() == 2 || last == "parent" || last == "child" || last == "link" ||
         last == "joint" || last == "coordinate";
}

// Which keys a load needs follows from its type.
bool load_type_is_known(const Tree& model, const std::string& path) {
  const std::vector<std::string> parts = split_path(path);
  bool reported = false;
  if (parts[0] == "load") locate(model, parts[0] + "." + parts[1] + ".type", &reported);
  return !reported;
}

void check_structure(const Linkage& linkage, const Tree& model, Diagnostics& diagnostics) {
  const bool known = structure_is_known(model);
  for (Problem& problem : check(linkage)) {
    bool reported = false;
    const Location at = locate(model, problem.path, &reported);
    if (reported || (!known && is_about_connections(problem.path))) continue;
    if (!load_type_is_known(model, problem.path)) continue;
    diagnostics.add(at, std::move(problem.message), std::move(problem.remedy));
  }
}

const Tree* descend(const Tree& tree, const std::string& part) {
  if (tree.is(Kind::table)) {
    const Tree* value = tree.find(part);
    // A link may give its inertia in the other form.
    return value == nullptr && part == "inertia" ? tree.find("inertia_at_origin") : value;
  }
  for (const Tree& item : tree.items) {
    const Tree* own = item.find("name");
    if (own != nullptr && own->is(Kind::text) && own->text == part) return &item;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool is_index = error == std::errc() && end == part.data() + part.size();
  return is_index && index < tree.items.size() ? &tree.items[index] : nullptr;
}

}  // namespace

Location locate(const Tree& document, const std::string& path, bool* reported) {
  const Tree* tree = &document;
  for (const std::string& part : split_path(path)) {
    const Tree* next = descend(*tree, part);
    if (next == nullptr) break;
    tree = next;
    if (!tree->is_valid() && reported != nullptr) *reported = true;
  }
  return tree->at;
}

ModelInput read_model(Tree model, Diagnostics& diagnostics) {
  ModelInput input;
  input.linkage = ModelReader(model, diagnostics).read();
  input.options = read_options(model, diagnostics);
  input.kinematics = read_kinematics(model, diagnostics);
  input.name = input.linkage.name;
  check_structure(input.linkage, model, diagnostics);
  input.resolved = std::move(model);
  return input;
}

}  // namespace linkstudy
