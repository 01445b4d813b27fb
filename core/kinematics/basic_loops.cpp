#include "core/kinematics/basic_loops.h"

#include <algorithm>

namespace linkstudy {
namespace {

// Bodies from one (left out) outwards to another.
std::vector<int> way_to(const Mechanism& m, int from, int to) {
  std::vector<int> bodies;
  for (; to != from; to = m.bodies[static_cast<std::size_t>(to)].parent) bodies.push_back(to);
  std::reverse(bodies.begin(), bodies.end());
  return bodies;
}

// Parents have lower numbers than their children.
int meeting_body(const Mechanism& m, int a, int b) {
  while (a != b) (a > b ? a : b) = m.bodies[static_cast<std::size_t>(std::max(a, b))].parent;
  return a;
}

std::vector<int> velocities_of(const Mechanism& m, const std::vector<int>& bodies) {
  std::vector<int> velocities;
  for (const int b : bodies) {
    const Body& body = m.bodies[static_cast<std::size_t>(b)];
    for (int k = 0; k < body.v_count; ++k) velocities.push_back(body.v_begin + k);
  }
  return velocities;
}

}  // namespace

std::vector<BasicLoop> find_basic_loops(const Mechanism& m) {
  std::vector<BasicLoop> loops;
  for (std::size_t i = 0; i < m.closures.size(); ++i) {
    const ClosureStructure& c = m.closures[i];
    BasicLoop loop;
    loop.closure = static_cast<int>(i);
    loop.common = meeting_body(m, c.first, c.second);
    const std::vector<int> out = way_to(m, loop.common, c.first);
    std::vector<int> back = way_to(m, loop.common, c.second);
    loop.first = velocities_of(m, out);
    loop.second = velocities_of(m, back);
    std::reverse(back.begin(), back.end());
    const auto add = [&](int b) {
      loop.joints.push_back("joint." + m.joint_names[static_cast<std::size_t>(b)]);
    };
    std::for_each(out.begin(), out.end(), add);
    loop.joints.push_back("closure." + m.closure_names[i]);
    std::for_each(back.begin(), back.end(), add);
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace linkstudy
