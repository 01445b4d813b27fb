// Mass matrix by composite rigid bodies ([Featherstone, ch. 6]) and bias forces by the recursive
// Newton-Euler algorithm ([Craig, ch. 6], used by [Urbas16] sec. 4), in ground axes about the
// bodies' origins:
//   f = m a + alpha x h + omega x (omega x h)
//   n = h x a + I alpha + omega x I omega
#pragma once

#include "core/model/parameters.h"
#include "core/model/walk.h"
#include "core/model/workspace.h"

namespace linkstudy {

// Wrench about the origin of a body that gives it the accelerations of its state.
template <class Real>
inline Wrench<Real> inertial_wrench(const Body& body, const BodyState<Real>& s) {
  const Inertia<Real>& i = s.inertia;
  Wrench<Real> w{zero3<Real>(), i.m * s.a_WB};
  const bool offset = body.center != VectorShape::zero;
  if (offset) w.moment = cross(i.h, s.a_WB);
  if (!body.rotates) return w;
  if (offset) {
    w.force = w.force + cross(s.w_WB, cross(s.w_WB, i.h));
    if (body.gyrates) w.force = w.force + cross(s.alpha_WB, i.h);
  }
  if (body.inertia != InertiaShape::isotropic) w.moment = w.moment + cross(s.w_WB, i.i * s.w_WB);
  if (body.gyrates) w.moment = w.moment + i.i * s.alpha_WB;
  return w;
}

template <class Real>
inline void update_inertial_wrenches(const Mechanism& m, Workspace<Real>& w) {
  for (const BodyIndex b : bodies_outwards(m)) {
    w.bodies[b].wrench = inertial_wrench(m.bodies[b], w.bodies[b]);
  }
}

// Generalised force of a wrench on a velocity with this axis.
template <class Real>
inline Real work_rate(const Velocity& k, Pitches<Real> pitch, const Vec3<Real>& axis,
                      const Wrench<Real>& w) {
  if (k.kind == VelocityKind::rotation) return dot(axis, w.moment);
  if (k.kind == VelocityKind::translation) return dot(axis, w.force);
  return madd(pitch[k.stage], dot(axis, w.force), dot(axis, w.moment));
}

template <class Real>
inline const Inertia<Real>& composite_of(const Body& body, const BodyState<Real>& s) {
  return body.carries ? s.composite : s.inertia;
}

// Adds what a body and all outboard need to its parent. A parent that cannot turn needs no moments.
template <class Real>
inline void pass_to_parent(const Body& body, const BodyState<Real>& s, bool parent_turns,
                           BodyState<Real>& parent) {
  const Inertia<Real>& composite = composite_of(body, s);
  parent.wrench.force = parent.wrench.force + s.wrench.force;
  if (!parent_turns) {
    parent.composite.m = parent.composite.m + composite.m;
    return;
  }
  parent.wrench.moment = parent.wrench.moment + s.wrench.moment;
  if (body.shifted) {
    parent.wrench.moment = parent.wrench.moment + cross(s.p_PB_W, s.wrench.force);
    add_inertia(parent.composite, shift_inertia(composite, s.p_PB_W));
  } else {
    add_inertia(parent.composite, composite);
  }
}

// Tips to ground: tau less bias, and composite inertias.
template <class Real>
inline void update_bias(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  for (const BodyIndex b : bodies_outwards(m)) {
    if (m.bodies[b].carries) w.bodies[b].composite = w.bodies[b].inertia;
  }
  for (const BodyIndex b : bodies_inwards(m)) {
    const Body& body = m.bodies[b];
    const BodyState<Real>& s = w.bodies[b];
    for (const VelocityIndex k : velocities_of(body)) {
      w.tau[k] = w.tau[k] - work_rate(m.velocities[k], p.pitch, w.axes[k], s.wrench);
    }
    if (body.parent == kGroundBody) continue;
    pass_to_parent(body, s, m.bodies[body.parent].rotates, w.bodies[body.parent]);
  }
}

// Wrench that accelerates a composite by one unit of a velocity.
template <class Real>
inline Wrench<Real> unit_wrench(const Velocity& k, Pitches<Real> pitch, const Vec3<Real>& axis,
                                const Inertia<Real>& c) {
  if (k.kind == VelocityKind::translation) return {cross(c.h, axis), c.m * axis};
  Wrench<Real> w{c.i * axis, cross(axis, c.h)};
  if (k.kind == VelocityKind::screw) {
    const Vec3<Real> advance = pitch[k.stage] * axis;
    w.moment = w.moment + cross(c.h, advance);
    w.force = madd(c.m, advance, w.force);
  }
  return w;
}

// Lower triangle of M on the paths to ground; entries off the paths are never touched.
template <class Real>
inline void update_mass_matrix(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  const Pitches<Real> pitch = p.pitch;
  for (const VelocityIndex k : velocities(m)) {
    const BodyIndex tip = m.velocities[k].body;
    const Velocities<Real> row = w.mass.row(k);
    Wrench<Real> f =
        unit_wrench(m.velocities[k], pitch, w.axes[k], composite_of(m.bodies[tip], w.bodies[tip]));
    for (const BodyIndex b : bodies_to_ground(m, tip)) {
      const Body& body = m.bodies[b];
      for (const VelocityIndex i : velocities_of(body)) {
        if (i <= k) row[i] = work_rate(m.velocities[i], pitch, w.axes[i], f);
      }
      if (!body.shifted) continue;
      f.moment = f.moment + cross(w.bodies[b].p_PB_W, f.force);
    }
  }
}

}  // namespace linkstudy
