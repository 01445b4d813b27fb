// A closure with clearance ([AugUrb18] eqs. (13)-(17)): at every contact a normal force
// (core/laws/normal_contact.h) and LuGre friction (core/laws/lugre_friction.h) between journal and
// bearing, equal and opposite at one point in space.
//   on the journal   -N n at c + X,   -mu N t at K = c + r_b u
//   (core/kinematics/contact_kinematics.h; there too: friction at two points)
// Their power leaves the bodies as N delta_dot + mu N v_t: K delta^n delta_dot is stored, the rest
// is dissipated (what the bristles store counts as dissipated).
#pragma once

#include "core/kinematics/contact_kinematics.h"
#include "core/model/contact_approach.h"

namespace linkstudy {

template <class Real>
inline Real free_bristle_rate(FreeBristle rule, const ClearanceParameters<Real>& n, Real z) {
  return rule == FreeBristle::relax ? Real(0.0) - n.relaxation * z : Real(0.0);
}

template <class Real>
inline void add_contact_wrench(const ClearanceStructure& c, const ContactGeometry<Real>& k,
                               const Vec3<Real>& axis, const ContactState<Real>& s,
                               ClosureState<Real>& x) {
  const Real sign(c.bearing_first ? -1.0 : 1.0);
  const Vec3<Real> force = sign * (madd(Real(0.0) - s.normal, k.n, (Real(0.0) - s.friction) * k.t));
  const Vec3<Real> couple = (sign * (Real(0.0) - s.friction) * k.arm) * axis;
  x.contact_force = x.contact_force + force;
  x.contact_moment = x.contact_moment + cross(k.point - x.p_WF, force) + couple;
  if (c.points == ContactPoints::one) return;
  // The journal's arm is longer by the depth, whichever body carries it.
  const Vec3<Real> more = ((Real(0.0) - s.friction) * k.depth) * axis;
  if (!c.bearing_first) x.contact_moment = x.contact_moment + more;
  x.contact_surplus = x.contact_surplus + more;
}

// Friction of one contact, and the rates of its bristle.
template <class Real, class Mask, class W>
inline Real contact_friction(const ClearanceStructure& structure, const ContactStructure& contact,
                             const ClearanceParameters<Real>& n, const Mask& acts,
                             ContactState<Real>& s, W& w) {
  if (!contact.z.exists()) return Real(0.0);
  const Real z = w.z[contact.z];
  const Real free_rate = free_bristle_rate(structure.free_bristle, n, z);
  if (!any(acts)) {
    w.z_rate[contact.z] = free_rate;
    return Real(0.0);
  }
  const LugreState<Real> f = lugre_friction(n.friction, z, s.speed);
  w.z_rate[contact.z] = select(acts, f.z_rate, free_rate);
  s.relaxation = select(acts, f.relaxation, Real(0.0));
  return f.mu * s.normal;
}

template <class Real>
[[gnu::noinline]] void add_contact(const Mechanism& m, ClearanceIndex c, ContactIndex i,
                                   const JournalInBearing<Real>& j,
                                   const ClearanceParameters<Real>& n, ClosureState<Real>& x,
                                   Workspace<Real>& w) {
  const ClearanceStructure& structure = m.clearances[c];
  const ContactStructure& contact = m.contacts[i];
  const ContactMemory<Real>& memory = w.memory[i];
  ContactState<Real>& s = w.contacts[i];
  const ContactGeometry<Real> k = contact_geometry(j, contact, n);
  s.eccentricity = Real(-1.0) * k.x;
  s.depth = k.depth;
  s.rate = k.rate;
  s.speed = structure.points == ContactPoints::one
                ? k.speed
                : madd(k.depth, dot(j.omega_journal, j.a), k.speed);
  s.normal = s.elastic = s.friction = s.relaxation = Real(0.0);
  s.approach = approach_speed(structure.approach, memory, k.depth, k.rate);
  const auto acts = k.depth > memory.least_depth;
  if (any(acts)) {
    const Real depth = select(acts, k.depth, Real(0.0));
    const ContactForce<Real> f = normal_contact_force(n.contact, structure.hertz, depth, k.rate,
                                                      s.approach, structure.approach);
    s.normal = select(acts, f.normal, Real(0.0));
    s.elastic = select(acts, f.elastic, Real(0.0));
  }
  s.friction = contact_friction(structure, contact, n, acts, s, w);
  if (!any(acts)) return;
  add_contact_wrench(structure, k, j.a, s, x);
  const Real power = madd(s.friction, s.speed, (s.normal - s.elastic) * s.rate);
  w.dissipated_power = w.dissipated_power + power;
  w.contact_power = w.contact_power + power;
}

template <class Real>
inline void add_clearance_joints(const Mechanism& m, const Parameters<Real>& p,
                                 Workspace<Real>& w) {
  BodyStates<Real>& bodies = w.bodies;
  for_journals(m, p, w, [&](ClearanceIndex c, const JournalInBearing<Real>& j) {
    const ClosureIndex index = m.clearances[c].closure;
    const ClosureStructure& closure = m.closures[index];
    ClosureState<Real>& x = w.closures[index];
    x.contact_force = x.contact_moment = x.contact_surplus = zero3<Real>();
    for (const ContactIndex i : contacts_of(m.clearances[c])) {
      add_contact(m, c, i, j, p.clearances[c], x, w);
    }
    subtract_contact_forces(closure, x, bodies, bodies[closure.first].wrench,
                            bodies[closure.second].wrench);
  });
}

}  // namespace linkstudy
