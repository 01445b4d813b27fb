#include "core/model/compile_motion.h"

#include <algorithm>

#include "core/topology/motion_numbers.h"

namespace linkstudy {
namespace {

// True if `end` is velocity k or comes after it on a path from ground.
bool leads_to(const Mechanism& m, VelocityIndex k, VelocityIndex end) {
  while (end > k) end = m.v_parent[end];
  return end == k;
}

// Where the mass matrix has entries beside that of the coordinate.
void add_support(MotionStructure& s, Mechanism& m) {
  s.support_begin = m.motion_support.end_index();
  for (const VelocityIndex k : velocities(m)) {
    if (k != s.v && (leads_to(m, k, s.v) || leads_to(m, s.v, k))) m.motion_support.push_back(k);
  }
  s.support_end = m.motion_support.end_index();
}

}  // namespace

void compile_motion(const Motion& motion, const Body& body, Model& model) {
  Mechanism& m = model.mechanism;
  Parameters<double>& p = model.parameters;
  MotionStructure s{.q = body.q_begin + motion.coordinate,
                    .v = body.v_begin + motion.coordinate,
                    .law = motion.law};
  double& q = model.start.q[s.q];
  const MotionNumbers n = motion_numbers(motion, q);
  s.rises = n.rises;
  s.knot_begin = p.knots.end_index();
  p.motions.push_back(n.parameters);
  p.knots.insert(p.knots.end(), n.knots.begin(), n.knots.end());
  s.knot_end = p.knots.end_index();
  m.knots = s.knot_end.value();
  add_support(s, m);
  q = n.at(0.0).q;
  model.start.v[s.v] = n.at(0.0).v;
  if (std::find(model.held.begin(), model.held.end(), s.v) == model.held.end()) {
    model.held.push_back(s.v);
  }
  m.motions.push_back(s);
  m.motion_names.push_back(motion.name);
}

}  // namespace linkstudy
