#include "core/model/compile_motion.h"

#include <algorithm>

#include "core/topology/motion_numbers.h"

namespace linkstudy {
namespace {

// True if `end` is velocity k or comes after it on a path from ground.
bool leads_to(const Mechanism& m, int k, int end) {
  while (end > k) end = m.v_parent[static_cast<std::size_t>(end)];
  return end == k;
}

// Where the mass matrix has entries beside that of the coordinate.
void add_support(MotionStructure& s, Mechanism& m) {
  s.support_begin = static_cast<int>(m.motion_support.size());
  for (int k = 0; k < m.nv; ++k) {
    if (k != s.v && (leads_to(m, k, s.v) || leads_to(m, s.v, k))) m.motion_support.push_back(k);
  }
  s.support_end = static_cast<int>(m.motion_support.size());
}

}  // namespace

void compile_motion(const Motion& motion, const Body& body, Model& model) {
  Mechanism& m = model.mechanism;
  Parameters<double>& p = model.parameters;
  MotionStructure s{.q = body.q_begin + motion.coordinate,
                    .v = body.v_begin + motion.coordinate,
                    .law = motion.law};
  double& q = model.start.q[static_cast<std::size_t>(s.q)];
  const MotionNumbers n = motion_numbers(motion, q);
  s.rises = n.rises;
  s.knot_begin = m.knots;
  p.motions.push_back(n.parameters);
  p.knots.insert(p.knots.end(), n.knots.begin(), n.knots.end());
  s.knot_end = m.knots = static_cast<int>(p.knots.size());
  add_support(s, m);
  q = n.at(0.0).q;
  model.start.v[static_cast<std::size_t>(s.v)] = n.at(0.0).v;
  if (std::find(model.held.begin(), model.held.end(), s.v) == model.held.end()) {
    model.held.push_back(s.v);
  }
  m.motions.push_back(s);
  m.motion_names.push_back(motion.name);
}

}  // namespace linkstudy
