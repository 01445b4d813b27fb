// Reactions in the tree joints by recursive Newton-Euler, tips to ground ([Urbas16] sec. 4,
// [Craig, ch. 6]), after `evaluate`. The reaction of a joint is the whole wrench that its parent
// puts on its child through it, drive and resistance of the joint included: force, and moment about
// the joint origin (the child's internal origin), ground axes. Closure forces of both kinds are
// external loads here. Where cut rows are redundant the reactions are those of the least-norm
// multipliers (core/dynamics/shared_reactions.h: others).
#pragma once

#include "core/dynamics/mass_matrix.h"
#include "core/forces/point_springs.h"
#include "core/kinematics/body_accelerations.h"
#include "core/kinematics/closure_kinematics.h"

namespace linkstudy {

template <class Real>
inline Reactions<Real> make_reactions(const Mechanism& m) {
  return {std::vector<BodyState<Real>>(m.bodies.size()),
          std::vector<Wrench<Real>>(m.bodies.size())};
}

// What moves a body, less what acts on it beside joints.
template <class Real>
inline void sum_free_body_wrenches(const Mechanism& m, const Parameters<Real>& p,
                                   const Workspace<Real>& w, Reactions<Real>& r) {
  r.moving = w.bodies;
  at(r.on_child, 0) = {zero3<Real>(), zero3<Real>()};
  for (const int b : bodies_outwards(m)) {
    add_joint_accelerations(m, p, w, b, r.moving);
    Body body = at(m.bodies, b);
    body.gyrates = body.rotates;  // alpha is no longer that of qdd = 0
    at(r.on_child, b) = inertial_wrench(body, at(r.moving, b));
  }
  for (const int i : indices_of(m.loads)) {
    const int body = at(m.loads, i).body;
    if (body < 0) continue;
    Wrench<Real>& sum = at(r.on_child, body);
    sum.force = sum.force - at(w.link_loads, i).force;
    sum.moment = sum.moment - at(w.link_loads, i).moment;
  }
  for (const int i : indices_of(m.point_springs)) {
    const PointSpringStructure& s = at(m.point_springs, i);
    subtract_spring_force(at(w.point_springs, i), at(r.on_child, s.first),
                          at(r.on_child, s.second));
  }
  const auto subtract = [&](int i) {
    const ClosureStructure& c = at(m.closures, i);
    subtract_closure_forces(c, at(w.closures, i), w.bodies.data(), at(r.on_child, c.first),
                            at(r.on_child, c.second));
    if (c.model != ClosureModel::clearance) return;
    subtract_contact_forces(c, at(w.closures, i), w.bodies.data(), at(r.on_child, c.first),
                            at(r.on_child, c.second));
  };
  for (const RowStorage storage : {RowStorage::cut, RowStorage::sde}) {
    for (const int i : indices_of(m.closures)) {
      if (storage_of(at(m.closures, i).model) == storage) subtract(i);
    }
  }
}

template <class Real>
inline void update_reactions(const Mechanism& m, const Parameters<Real>& p,
                             const Workspace<Real>& w, Reactions<Real>& r) {
  sum_free_body_wrenches(m, p, w, r);
  for (const int b : bodies_inwards(m)) {
    const int parent = at(m.bodies, b).parent;
    Wrench<Real>& sum = at(r.on_child, parent);
    add_force(sum, at(w.bodies, b).p - at(w.bodies, parent).p, at(r.on_child, b).force);
    sum.moment = sum.moment + at(r.on_child, b).moment;
  }
}

}  // namespace linkstudy
