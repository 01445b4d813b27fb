// End stops of joint coordinates: contacts (core/laws/normal_contact.h) between a coordinate and
// its limit. With the depth d = q - high or low - q, d' its rate,
//   f = K d^n (1 + D d' / v0),   or   f = max(K d^n + b d', 0) where a damping b is given,
// on the coordinate -f at the high end and +f at the low one. K d^n d' is stored, the rest of f d'
// dissipated. What contacts remember is as for clearances (core/forces/contact_memory.h).
#pragma once

#include "core/model/contact_approach.h"
#include "core/model/parameters.h"

namespace linkstudy {

// Depth at a coordinate, or its rate.
template <class Real>
inline Real towards_stop(const StopStructure& s, Real x) {
  return s.is_high ? x : Real(0.0) - x;
}

template <class Real>
inline Real stop_depth(const StopStructure& s, const StopParameters<Real>& n,
                       Positions<const Real> q) {
  return towards_stop(s, q[s.q] - n.limit);
}

template <class Real>
inline ContactForce<Real> stop_force(const StopStructure& s, const StopParameters<Real>& n,
                                     Real depth, Real rate, Real approach) {
  ContactForce<Real> f =
      normal_contact_force(n.contact, s.hertz, depth, rate, approach, s.approach);
  if (s.is_viscous) f.normal = max(madd(n.damping, rate, f.elastic), Real(0.0));
  return f;
}

template <class Real>
inline void add_stop(const StopStructure& s, const StopParameters<Real>& n, Positions<const Real> q,
                     Velocities<const Real> v, Workspace<Real>& w) {
  const ContactMemory<Real>& memory = w.memory[s.contact];
  ContactState<Real>& x = w.contacts[s.contact];
  x.depth = stop_depth(s, n, q);
  x.rate = towards_stop(s, v[s.v]);
  x.approach = approach_speed(s.approach, memory, x.depth, x.rate);
  const auto acts = x.depth > memory.least_depth;
  const ContactForce<Real> f = stop_force(s, n, x.depth, x.rate, x.approach);
  x.normal = select(acts, f.normal, Real(0.0));
  x.elastic = select(acts, f.elastic, Real(0.0));
  w.tau[s.v] = w.tau[s.v] - towards_stop(s, x.normal);
  w.dissipated_power = madd(x.normal - x.elastic, x.rate, w.dissipated_power);
  w.contact_power = madd(x.normal - x.elastic, x.rate, w.contact_power);
}

template <class Real>
inline void add_stops(const Mechanism& m, const Parameters<Real>& p, Positions<const Real> q,
                      Velocities<const Real> v, Workspace<Real>& w) {
  for (const StopIndex i : indices_of(m.stops)) add_stop(m.stops[i], p.stops[i], q, v, w);
}

}  // namespace linkstudy
