// Reactions in the tree joints by recursive Newton-Euler, tips to ground ([Urbas16] sec. 4,
// [Craig, ch. 6]), after `evaluate`. The reaction of a joint is the whole wrench that its parent
// puts on its child through it, drive and resistance of the joint included: force, and moment about
// the joint origin (the child's internal origin), ground axes. Closure forces of both kinds are
// external loads here. Where cut rows are redundant the reactions are those of the least-norm
// multipliers.
#pragma once

#include "core/dynamics/mass_matrix.h"
#include "core/kinematics/closure_kinematics.h"

namespace linkstudy {

// Accelerations with qdd: what each velocity adds is alpha += e qdd (rotation), a += e qdd
// (translation), carried outwards by a += alpha x shift.
template <class Real>
inline void add_joint_accelerations(const Mechanism& m, const Parameters<Real>& p,
                                    const Workspace<Real>& w, std::size_t b,
                                    std::vector<BodyState<Real>>& moving) {
  const Body& body = m.bodies[b];
  const auto parent = static_cast<std::size_t>(body.parent);
  BodyState<Real>& s = moving[b];
  const BodyState<Real>& sp = moving[parent];
  Vec3<Real> alpha = sp.alpha - w.bodies[parent].alpha;
  Vec3<Real> a = sp.a - w.bodies[parent].a + cross(alpha, w.bodies[b].p - w.bodies[parent].p);
  for (int k = body.v_begin; k < body.v_begin + body.v_count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec3<Real> e = w.qdd[i] * w.axes[i];
    if (m.velocities[i].kind == VelocityKind::translation) {
      a = a + e;
      continue;
    }
    alpha = alpha + e;
    if (m.velocities[i].kind == VelocityKind::screw) {
      a = madd(p.pitch[static_cast<std::size_t>(m.velocities[i].stage)], e, a);
    }
  }
  s.alpha = s.alpha + alpha;
  s.a = s.a + a;
}

// reactions: (nb), [0] the sum on ground, about its origin. moving: (nb) scratch.
template <class Real>
inline void update_reactions(const Mechanism& m, const Parameters<Real>& p,
                             const Workspace<Real>& w, std::vector<BodyState<Real>>& moving,
                             std::vector<Wrench<Real>>& reactions) {
  const auto nb = m.bodies.size();
  moving = w.bodies;
  reactions[0] = {zero3<Real>(), zero3<Real>()};
  for (std::size_t b = 1; b < nb; ++b) {
    add_joint_accelerations(m, p, w, b, moving);
    Body body = m.bodies[b];
    body.gyrates = body.rotates;  // alpha is no longer that of qdd = 0
    reactions[b] = inertial_wrench(body, moving[b]);
  }
  for (std::size_t i = 0; i < m.loads.size(); ++i) {
    if (m.loads[i].body < 0) continue;
    Wrench<Real>& r = reactions[static_cast<std::size_t>(m.loads[i].body)];
    r.force = r.force - w.link_loads[i].force;
    r.moment = r.moment - w.link_loads[i].moment;
  }
  for (std::size_t i = 0; i < m.closures.size(); ++i) {
    const ClosureStructure& c = m.closures[i];
    subtract_closure_forces(c, w.closures[i], w.bodies.data(),
                            reactions[static_cast<std::size_t>(c.first)],
                            reactions[static_cast<std::size_t>(c.second)]);
  }
  for (std::size_t b = nb - 1; b > 0; --b) {
    const auto parent = static_cast<std::size_t>(m.bodies[b].parent);
    add_force(reactions[parent], w.bodies[b].p - w.bodies[parent].p, reactions[b].force);
    reactions[parent].moment = reactions[parent].moment + reactions[b].moment;
  }
}

}  // namespace linkstudy
