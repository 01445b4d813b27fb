#include "study/config/started_model.h"

#include <algorithm>

#include "study/config/toml_writer.h"

namespace linkstudy {
namespace {

Tree numbers_tree(const std::vector<double>& values, int begin, int count) {
  Tree list = Tree::make_array();
  for (int i = 0; i < count; ++i) {
    list.items.push_back(Tree::make_number(values[static_cast<std::size_t>(begin + i)]));
  }
  return list;
}

}  // namespace

std::string started_model_text(const ModelInput& input, const Model& started) {
  Tree model = input.resolved;
  const Mechanism& m = started.mechanism;
  for (Tree& joint : model.find("joint")->items) {
    const auto name = std::ranges::find(m.joint_names, joint.find("name")->text);
    const Body& body = m.bodies[static_cast<std::size_t>(name - m.joint_names.begin())];
    if (body.v_count == 0) continue;
    Tree* initial = joint.find("initial");
    Tree& start = initial != nullptr ? *initial : joint.set("initial", Tree::make_table());
    start.set("position", numbers_tree(started.start.q, body.q_begin, body.q_count));
    start.set("velocity", numbers_tree(started.start.v, body.v_begin, body.v_count));
  }
  return write_toml(model);
}

}  // namespace linkstudy
