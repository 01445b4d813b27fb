#include "core/kinematics/basic_loops.h"

#include <algorithm>

#include "core/model/walk.h"

namespace linkstudy {
namespace {

// Bodies from one (left out) outwards to another.
std::vector<BodyIndex> way_to(const Mechanism& m, BodyIndex from, BodyIndex to) {
  std::vector<BodyIndex> bodies;
  for (; to != from; to = m.bodies[to].parent) bodies.push_back(to);
  std::reverse(bodies.begin(), bodies.end());
  return bodies;
}

// Parents have lower numbers than their children.
BodyIndex meeting_body(const Mechanism& m, BodyIndex a, BodyIndex b) {
  while (a != b) (a > b ? a : b) = m.bodies[std::max(a, b)].parent;
  return a;
}

std::vector<VelocityIndex> velocities_of(const Mechanism& m, const std::vector<BodyIndex>& bodies) {
  std::vector<VelocityIndex> velocities;
  for (const BodyIndex b : bodies) {
    for (const VelocityIndex k : velocities_of(m.bodies[b])) velocities.push_back(k);
  }
  return velocities;
}

}  // namespace

std::vector<BasicLoop> find_basic_loops(const Mechanism& m) {
  std::vector<BasicLoop> loops;
  for (const ClosureIndex i : indices_of(m.closures)) {
    const ClosureStructure& c = m.closures[i];
    BasicLoop loop;
    loop.closure = i;
    loop.common = meeting_body(m, c.first, c.second);
    const std::vector<BodyIndex> out = way_to(m, loop.common, c.first);
    std::vector<BodyIndex> back = way_to(m, loop.common, c.second);
    loop.first = velocities_of(m, out);
    loop.second = velocities_of(m, back);
    std::reverse(back.begin(), back.end());
    const auto add = [&](BodyIndex b) { loop.joints.push_back("joint." + m.joint_names[b]); };
    std::for_each(out.begin(), out.end(), add);
    loop.joints.push_back("closure." + m.closure_names[i]);
    std::for_each(back.begin(), back.end(), add);
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace linkstudy
