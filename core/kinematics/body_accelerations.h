// Accelerations of all bodies once those of the joint coordinates are known, ground to tips, after
// `update_kinematics`. As in the Workspace they are less gravity: g is to be added to get those of
// the motion.
#pragma once

#include "core/model/parameters.h"
#include "core/model/walk.h"
#include "core/model/workspace.h"

namespace linkstudy {

// Accelerations with qdd: what each velocity adds is alpha += e qdd (rotation), a += e qdd
// (translation), carried outwards by a += alpha x shift.
template <class M, class B, class Real, class Bodies>
inline void add_joint_accelerations(const M& m, const Parameters<Real>& p,
                                    const Workspace<Real, M>& w, B b, Bodies& moving) {
  const auto parent = parent_of(m, b);
  BodyState<Real>& s = at(moving, b);
  const BodyState<Real>& sp = at(moving, parent);
  const BodyState<Real>& wp = at(w.bodies, parent);
  Vec3<Real> alpha = sp.alpha - wp.alpha;
  Vec3<Real> a = sp.a - wp.a + cross(alpha, at(w.bodies, b).p - wp.p);
  for_velocities_of(m, b, [&](auto k) {
    const Velocity& velocity = at(m.velocities, k);
    const Vec3<Real> e = at(w.qdd, k) * at(w.axes, k);
    if (velocity.kind == VelocityKind::translation) {
      a = a + e;
      return;
    }
    alpha = alpha + e;
    if (velocity.kind == VelocityKind::screw) a = madd(at(p.pitch, velocity.stage), e, a);
  });
  s.alpha = s.alpha + alpha;
  s.a = s.a + a;
}

// The states of `w` with accelerations of its qdd; `moving` is as long as they are.
template <class M, class Real, class Bodies>
inline void update_body_accelerations(const M& m, const Parameters<Real>& p,
                                      const Workspace<Real, M>& w, Bodies& moving) {
  moving = w.bodies;
  for_bodies(m, [&](auto b) { add_joint_accelerations(m, p, w, b, moving); });
}

}  // namespace linkstudy
