// Mass matrix by composite rigid bodies ([Featherstone, ch. 6]) and bias forces by the recursive
// Newton-Euler algorithm ([Craig, ch. 6], used by [Urbas16] sec. 4). Both in ground axes about O.
#pragma once

#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

// Composite inertias and the force that the motion with qdd = 0 needs, tips to ground;
// tau = loads - bias.
template <class Real>
inline void update_bias(const Mechanism& m, Workspace<Real>& w) {
  BodyState<Real>* bodies = w.bodies.data();
  const int nb = m.body_count();
  for (int b = 1; b < nb; ++b) {
    BodyState<Real>& s = bodies[b];
    const Force<Real> momentum = s.inertia * s.v;
    s.force = s.inertia * s.a + cross(s.v, momentum) - s.external;
    s.composite = s.inertia;
  }
  for (int b = nb - 1; b > 0; --b) {
    const Body& body = m.bodies[static_cast<std::size_t>(b)];
    const BodyState<Real>& s = bodies[b];
    for (int k = body.v_begin; k < body.v_begin + body.v_count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      w.tau[i] = w.tau[i] - dot(w.axes[i], s.force);
    }
    if (body.parent == 0) continue;
    BodyState<Real>& parent = bodies[body.parent];
    parent.force = parent.force + s.force;
    parent.composite = parent.composite + s.composite;
  }
}

// Lower triangle of M on the paths to ground; entries off the paths are never touched.
template <class Real>
inline void update_mass_matrix(const Mechanism& m, Workspace<Real>& w) {
  const int nv = m.nv;
  const int* parent = m.v_parent.data();
  const int* body = m.v_body.data();
  const Motion<Real>* axes = w.axes.data();
  Real* mass = w.mass.data();
  for (int k = 0; k < nv; ++k) {
    const Force<Real> f = w.bodies[static_cast<std::size_t>(body[k])].composite * axes[k];
    for (int i = k; i >= 0; i = parent[i]) mass[k * nv + i] = dot(axes[i], f);
  }
}

}  // namespace linkstudy
