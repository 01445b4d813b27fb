// Mass matrix by composite rigid bodies ([Featherstone, ch. 6]) and bias forces by the recursive
// Newton-Euler algorithm ([Craig, ch. 6], used by [Urbas16] sec. 4), in ground axes about the
// bodies' origins:
//   f = m a + alpha x h + omega x (omega x h)
//   n = h x a + I alpha + omega x I omega
#pragma once

#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

// Wrench about the origin of a body that gives it the accelerations of its state.
template <class Real>
inline Wrench<Real> inertial_wrench(const Body& body, const BodyState<Real>& s) {
  const Inertia<Real>& i = s.inertia;
  Wrench<Real> w{zero3<Real>(), i.m * s.a};
  const bool offset = body.center != VectorShape::zero;
  if (offset) w.moment = cross(i.h, s.a);
  if (!body.rotates) return w;
  if (offset) {
    w.force = w.force + cross(s.omega, cross(s.omega, i.h));
    if (body.gyrates) w.force = w.force + cross(s.alpha, i.h);
  }
  if (body.inertia != InertiaShape::isotropic) {
    w.moment = w.moment + cross(s.omega, i.i * s.omega);
  }
  if (body.gyrates) w.moment = w.moment + i.i * s.alpha;
  return w;
}

template <class Real>
inline void update_inertial_wrenches(const Mechanism& m, Workspace<Real>& w) {
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    w.bodies[b].wrench = inertial_wrench(m.bodies[b], w.bodies[b]);
  }
}

// Generalised force of a wrench on velocity k.
template <class Real>
inline Real work_rate(const Mechanism& m, const Parameters<Real>& p, int k, const Vec3<Real>& axis,
                      const Wrench<Real>& w) {
  const auto i = static_cast<std::size_t>(k);
  if (m.v_screw[i] >= 0) {
    return madd(p.pitch[static_cast<std::size_t>(m.v_screw[i])], dot(axis, w.force),
                dot(axis, w.moment));
  }
  return dot(axis, m.v_rotates[i] ? w.moment : w.force);
}

// Tips to ground: tau less bias, and composite inertias.
template <class Real>
inline void update_bias(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  BodyState<Real>* bodies = w.bodies.data();
  const int nb = m.body_count();
  for (int b = 1; b < nb; ++b) bodies[b].composite = bodies[b].inertia;
  for (int b = nb - 1; b > 0; --b) {
    const Body& body = m.bodies[static_cast<std::size_t>(b)];
    const BodyState<Real>& s = bodies[b];
    for (int k = body.v_begin; k < body.v_begin + body.v_count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      w.tau[i] = w.tau[i] - work_rate(m, p, k, w.axes[i], s.wrench);
    }
    if (body.parent == 0) continue;
    BodyState<Real>& parent = bodies[body.parent];
    const bool turns = m.bodies[static_cast<std::size_t>(body.parent)].rotates;
    parent.wrench.force = parent.wrench.force + s.wrench.force;
    if (!turns) {
      parent.composite.m = parent.composite.m + s.composite.m;
      continue;
    }
    parent.wrench.moment = parent.wrench.moment + s.wrench.moment;
    if (body.shifted) {
      parent.wrench.moment = parent.wrench.moment + cross(s.shift, s.wrench.force);
      add_inertia(parent.composite, shift_inertia(s.composite, s.shift));
    } else {
      add_inertia(parent.composite, s.composite);
    }
  }
}

// Wrench that accelerates a composite by one unit of velocity k.
template <class Real>
inline Wrench<Real> unit_wrench(const Mechanism& m, const Parameters<Real>& p, int k,
                                const Vec3<Real>& axis, const Inertia<Real>& c) {
  const auto i = static_cast<std::size_t>(k);
  if (!m.v_rotates[i]) return {cross(c.h, axis), c.m * axis};
  Wrench<Real> w{c.i * axis, cross(axis, c.h)};
  if (m.v_screw[i] >= 0) {
    const Vec3<Real> advance = p.pitch[static_cast<std::size_t>(m.v_screw[i])] * axis;
    w.moment = w.moment + cross(c.h, advance);
    w.force = madd(c.m, advance, w.force);
  }
  return w;
}

// Lower triangle of M on the paths to ground; entries off the paths are never touched.
template <class Real>
inline void update_mass_matrix(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  const int nv = m.nv;
  const Vec3<Real>* axes = w.axes.data();
  for (int k = 0; k < nv; ++k) {
    Real* row = w.mass.data() + k * nv;
    int b = m.v_body[static_cast<std::size_t>(k)];
    Wrench<Real> f = unit_wrench(m, p, k, axes[k], w.bodies[static_cast<std::size_t>(b)].composite);
    int i = k;
    while (true) {
      const Body& body = m.bodies[static_cast<std::size_t>(b)];
      for (; i >= body.v_begin; --i) row[i] = work_rate(m, p, i, axes[i], f);
      if (body.parent == 0) break;
      if (body.shifted) {
        f.moment = f.moment + cross(w.bodies[static_cast<std::size_t>(b)].shift, f.force);
      }
      b = body.parent;
      const Body& next = m.bodies[static_cast<std::size_t>(b)];
      i = next.v_begin + next.v_count - 1;
    }
  }
}

}  // namespace linkstudy
