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
template <class Real>
inline void add_joint_accelerations(const Mechanism& m, const Parameters<Real>& p,
                                    const Workspace<Real>& w, BodyIndex b,
                                    BodyStates<Real>& moving) {
  const BodyIndex parent = m.bodies[b].parent;
  BodyState<Real>& s = moving[b];
  const BodyState<Real>& sp = moving[parent];
  const BodyState<Real>& wp = w.bodies[parent];
  Vec3<Real> alpha = sp.alpha_WB - wp.alpha_WB;
  Vec3<Real> a = sp.a_WB - wp.a_WB + cross(alpha, w.bodies[b].p_WB - wp.p_WB);
  for (const VelocityIndex k : velocities_of(m.bodies[b])) {
    const Velocity& velocity = m.velocities[k];
    const Vec3<Real> e = w.qdd[k] * w.axes[k];
    if (velocity.kind == VelocityKind::translation) {
      a = a + e;
      continue;
    }
    alpha = alpha + e;
    if (velocity.kind == VelocityKind::screw) a = madd(p.pitch[velocity.stage], e, a);
  }
  s.alpha_WB = s.alpha_WB + alpha;
  s.a_WB = s.a_WB + a;
}

// The states of `w` with accelerations of its qdd; `moving` is as long as they are.
template <class Real>
inline void update_body_accelerations(const Mechanism& m, const Parameters<Real>& p,
                                      const Workspace<Real>& w, BodyStates<Real>& moving) {
  moving = w.bodies;
  for (const BodyIndex b : bodies_outwards(m)) add_joint_accelerations(m, p, w, b, moving);
}

}  // namespace linkstudy
