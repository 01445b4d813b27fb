#include <algorithm>
#include <tuple>

#include "core/model/mechanism.h"

namespace linkstudy {
namespace {

auto key(const Body& b) {
  return std::tuple(b.parent, b.stage_begin, b.stage_end, b.q_begin, b.v_begin, b.frame,
                    b.quarter.axis, b.quarter.sign, b.offset, b.center, b.inertia);
}
auto key(const Stage& s) {
  return std::tuple(s.motion, s.q, s.v);
}
auto key(const Row& r) {
  return std::tuple(r.kind, r.closure, r.axis, r.other, r.sign, r.direction);
}
auto key(const ClosureStructure& c) {
  return std::tuple(c.first, c.second, c.model, c.stabilization, c.row_begin, c.row_end, c.point_1,
                    c.point_2);
}
auto key(const JointSpring& s) {
  return std::tuple(s.q, s.v);
}
auto key(const ClearanceStructure& c) {
  return std::tuple(c.closure, c.bearing_first, c.hertz, c.approach, c.points, c.free_bristle,
                    c.contact_begin, c.contact_end);
}
auto key(const ContactStructure& c) {
  return std::tuple(c.clearance, c.side, c.z);
}
auto key(const JointFrictionStructure& f) {
  return std::tuple(f.body, f.turn, f.slide, f.z);
}
auto key(const LoopJoint& j) {
  return std::tuple(j.group, j.body, j.closure, j.counts);
}
auto key(const LoadStructure& l) {
  return std::tuple(l.type, l.v, l.body, l.follows_link, l.course, l.law, l.table_begin,
                    l.table_end);
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return key(x) == key(y); });
}

}  // namespace

bool same_structure(const Mechanism& a, const Mechanism& b) {
  return same(a.bodies, b.bodies) && same(a.stages, b.stages) && same(a.closures, b.closures) &&
         same(a.cut_rows, b.cut_rows) && same(a.sde_rows, b.sde_rows) && same(a.loads, b.loads) &&
         same(a.joint_springs, b.joint_springs) && same(a.clearances, b.clearances) &&
         same(a.contacts, b.contacts) && same(a.frictions, b.frictions) &&
         same(a.loop_joints, b.loop_joints) && same(a.loop_rows, b.loop_rows);
}

}  // namespace linkstudy
