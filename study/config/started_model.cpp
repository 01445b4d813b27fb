#include "study/config/started_model.h"

#include <algorithm>

#include "core/topology/flexible_beam.h"
#include "study/config/toml_writer.h"

namespace linkstudy {
namespace {

void append_numbers(const std::vector<double>& values, int begin, int count, Tree& list) {
  for (int i = 0; i < count; ++i) {
    list.items.push_back(Tree::make_number(values[static_cast<std::size_t>(begin + i)]));
  }
}

Tree numbers_tree(const std::vector<double>& values, int begin, int count) {
  Tree list = Tree::make_array();
  append_numbers(values, begin, count, list);
  return list;
}

// The angles of a flexible link's elements are those of joints of its own; a link that is taken as
// rigid has none.
void start_beam(const std::string& link, const Model& started, Tree& beam) {
  const Mechanism& m = started.mechanism;
  Tree position = Tree::make_array(), velocity = Tree::make_array();
  for (int k = 1;; ++k) {
    const auto name = std::ranges::find(m.joint_names, element_joint_name(link, k));
    if (name == m.joint_names.end()) break;
    const Body& body = m.bodies[BodyIndex(name - m.joint_names.begin())];
    append_numbers(started.start.q, body.q_begin.value(), body.q_count, position);
    append_numbers(started.start.v, body.v_begin.value(), body.v_count, velocity);
  }
  if (position.items.empty()) return;
  Tree initial = Tree::make_table();
  initial.set("position", std::move(position));
  initial.set("velocity", std::move(velocity));
  beam.set("initial", std::move(initial));
}

}  // namespace

std::string started_model_text(const ModelInput& input, const Model& started) {
  Tree model = input.resolved;
  const Mechanism& m = started.mechanism;
  for (Tree& joint : model.find("joint")->items) {
    const auto name = std::ranges::find(m.joint_names, joint.find("name")->text);
    const Body& body = m.bodies[BodyIndex(name - m.joint_names.begin())];
    if (body.v_count == 0) continue;
    Tree* initial = joint.find("initial");
    Tree& start = initial != nullptr ? *initial : joint.set("initial", Tree::make_table());
    start.set("position", numbers_tree(started.start.q, body.q_begin.value(), body.q_count));
    start.set("velocity", numbers_tree(started.start.v, body.v_begin.value(), body.v_count));
  }
  for (Tree& link : model.find("link")->items) {
    Tree* beam = link.find("flexible");
    if (beam != nullptr) start_beam(link.find("name")->text, started, *beam);
  }
  return write_toml(model);
}

}  // namespace linkstudy
