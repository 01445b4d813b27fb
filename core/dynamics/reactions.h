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
  return {BodyStates<Real>(m.bodies.size()),
          IndexedVector<BodyIndex, Wrench<Real>>(m.bodies.size())};
}

// What moves a body, less what acts on it beside joints.
template <class Real>
inline void sum_free_body_wrenches(const Mechanism& m, const Parameters<Real>& p,
                                   const Workspace<Real>& w, Reactions<Real>& r) {
  r.moving = w.bodies;
  r.on_child[kGroundBody] = {zero3<Real>(), zero3<Real>()};
  for (const BodyIndex b : bodies_outwards(m)) {
    add_joint_accelerations(m, p, w, b, r.moving);
    Body body = m.bodies[b];
    body.gyrates = body.rotates;  // alpha is no longer that of qdd = 0
    r.on_child[b] = inertial_wrench(body, r.moving[b]);
  }
  for (const LoadIndex i : indices_of(m.loads)) {
    const BodyIndex body = m.loads[i].body;
    if (!body.exists()) continue;
    Wrench<Real>& sum = r.on_child[body];
    sum.force = sum.force - w.link_loads[i].force;
    sum.moment = sum.moment - w.link_loads[i].moment;
  }
  for (const PointSpringIndex i : indices_of(m.point_springs)) {
    const PointSpringStructure& s = m.point_springs[i];
    subtract_spring_force(w.point_springs[i], r.on_child[s.first], r.on_child[s.second]);
  }
  const auto subtract = [&](ClosureIndex i) {
    const ClosureStructure& c = m.closures[i];
    subtract_closure_forces(c, w.closures[i], w.bodies, r.on_child[c.first], r.on_child[c.second]);
    if (c.model != ClosureModel::clearance) return;
    subtract_contact_forces(c, w.closures[i], w.bodies, r.on_child[c.first], r.on_child[c.second]);
  };
  for (const RowStorage storage : {RowStorage::cut, RowStorage::sde}) {
    for (const ClosureIndex i : indices_of(m.closures)) {
      if (storage_of(m.closures[i].model) == storage) subtract(i);
    }
  }
}

template <class Real>
inline void update_reactions(const Mechanism& m, const Parameters<Real>& p,
                             const Workspace<Real>& w, Reactions<Real>& r) {
  sum_free_body_wrenches(m, p, w, r);
  for (const BodyIndex b : bodies_inwards(m)) {
    const BodyIndex parent = m.bodies[b].parent;
    Wrench<Real>& sum = r.on_child[parent];
    add_force(sum, w.bodies[b].p_WB - w.bodies[parent].p_WB, r.on_child[b].force);
    sum.moment = sum.moment + r.on_child[b].moment;
  }
}

}  // namespace linkstudy
