// Poses, velocities, qdd-free accelerations, unit motions and inertias of all bodies, ground to
// tips. X_WB = X_WP X_PJ X_J(q); gravity enters as an acceleration -g of the ground
// ([Featherstone, ch. 5.3]).
#pragma once

#include "core/kinematics/joint_kinematics.h"
#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

template <class Real>
inline void set_ground(const Parameters<Real>& p, BodyState<Real>& ground) {
  ground.r = identity3<Real>();
  ground.p = zero3<Real>();
  ground.v = {zero3<Real>(), zero3<Real>()};
  ground.a = {zero3<Real>(), Real(-1.0) * p.gravity};
}

template <class Real>
inline Moving<Real> joint_frame(const Body& body, const BodyParameters<Real>& n,
                                const BodyState<Real>& parent) {
  Moving<Real> x{parent.r, parent.p, parent.v, parent.a};
  if (body.parent == 0) {
    x.r = n.frame;
    x.p = n.origin;
    return x;
  }
  if (body.offset_frame) x.p = x.p + parent.r * n.origin;
  if (body.rotated_frame) x.r = parent.r * n.frame;
  return x;
}

template <class Real>
inline Inertia<Real> world_inertia(const Body& body, const BodyParameters<Real>& n,
                                   const Mat3<Real>& r, const Vec3<Real>& p) {
  const Vec3<Real> center = body.offset_mass ? p + r * n.center : p;
  const Sym3<Real> i =
      body.diagonal_inertia
          ? rotate_diagonal(r, Vec3<Real>{n.inertia.xx, n.inertia.yy, n.inertia.zz})
          : rotate(r, n.inertia);
  return shift_to_origin(n.mass, center, i);
}

template <class Real>
inline void update_kinematics(const Mechanism& m, const Parameters<Real>& p, const Real* q,
                              const Real* v, Workspace<Real>& w) {
  BodyState<Real>* bodies = w.bodies.data();
  Motion<Real>* axes = w.axes.data();
  set_ground(p, bodies[0]);
  const int nb = m.body_count();
  for (int b = 1; b < nb; ++b) {
    const Body& body = m.bodies[static_cast<std::size_t>(b)];
    const BodyParameters<Real>& n = p.bodies[static_cast<std::size_t>(b)];
    Moving<Real> x = joint_frame(body, n, bodies[body.parent]);
    for (int i = body.stage_begin; i < body.stage_end; ++i) {
      const Stage& stage = m.stages[static_cast<std::size_t>(i)];
      pass_stage(stage, p.pitch[static_cast<std::size_t>(i)], q + stage.q, v + stage.v, x,
                 axes + stage.v);
    }
    BodyState<Real>& s = bodies[b];
    s.r = x.r;
    s.p = x.p;
    s.v = x.v;
    s.a = x.a;
    s.inertia = world_inertia(body, n, x.r, x.p);
  }
}

}  // namespace linkstudy
