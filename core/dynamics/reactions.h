// Reactions in the tree joints by recursive Newton-Euler, tips to ground ([Urbas16] sec. 4,
// [Craig, ch. 6]), after `evaluate`. The reaction of a joint is the whole wrench that its parent
// puts on its child through it, drive and resistance of the joint included: force, and moment about
// the joint origin (the child's internal origin), ground axes. Closure forces of both kinds are
// external loads here. Where cut rows are redundant the reactions are those of the least-norm
// multipliers (core/dynamics/shared_reactions.h: others).
#pragma once

#include "core/dynamics/mass_matrix.h"
#include "core/kinematics/body_accelerations.h"
#include "core/kinematics/closure_kinematics.h"

namespace linkstudy {

// Scratch and result of `update_reactions`.
template <class Real, class M = Mechanism>
using Reactions = ReactionState<Real, Counts<M>::bodies>;

template <class Real, class M>
inline Reactions<Real, M> make_reactions(const M& m) {
  Reactions<Real, M> r{};
  if constexpr (!FixedStructure<M>) {
    r.moving.resize(m.bodies.size());
    r.on_child.resize(m.bodies.size());
  }
  return r;
}

// What moves a body, less what acts on it beside joints.
template <class M, class Real, class R>
inline void sum_free_body_wrenches(const M& m, const Parameters<Real>& p,
                                   const Workspace<Real, M>& w, R& r) {
  r.moving = w.bodies;
  at(r.on_child, 0) = {zero3<Real>(), zero3<Real>()};
  for_bodies(m, [&](auto b) {
    add_joint_accelerations(m, p, w, b, r.moving);
    Body body = at(m.bodies, b);
    body.gyrates = body.rotates;  // alpha is no longer that of qdd = 0
    at(r.on_child, b) = inertial_wrench(body, at(r.moving, b));
  });
  for_loads(m, [&](auto i) {
    const int body = at(m.loads, i).body;
    if (body < 0) return;
    Wrench<Real>& sum = at(r.on_child, body);
    sum.force = sum.force - at(w.link_loads, i).force;
    sum.moment = sum.moment - at(w.link_loads, i).moment;
  });
  const auto subtract = [&](auto i) {
    const ClosureStructure& c = at(m.closures, i);
    subtract_closure_forces(c, at(w.closures, i), w.bodies.data(), at(r.on_child, c.first),
                            at(r.on_child, c.second));
    if (c.model != ClosureModel::clearance) return;
    subtract_contact_forces(c, at(w.closures, i), w.bodies.data(), at(r.on_child, c.first),
                            at(r.on_child, c.second));
  };
  for_closures<ClosureModel::cut>(m, subtract);
  for_closures<ClosureModel::sde>(m, subtract);
}

template <class M, class Real, class R>
inline void update_reactions(const M& m, const Parameters<Real>& p, const Workspace<Real, M>& w,
                             R& r) {
  sum_free_body_wrenches(m, p, w, r);
  for_bodies_inwards(m, [&](auto b) {
    const auto parent = parent_of(m, b);
    Wrench<Real>& sum = at(r.on_child, parent);
    add_force(sum, at(w.bodies, b).p - at(w.bodies, parent).p, at(r.on_child, b).force);
    sum.moment = sum.moment + at(r.on_child, b).moment;
  });
}

}  // namespace linkstudy
