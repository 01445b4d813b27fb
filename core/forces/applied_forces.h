// Everything that acts on a linkage beside gravity and constraints; `update_applied_forces` is the
// only list of force kinds. Joint loads go to tau, the others come off BodyState::wrench; the
// powers of drives and of dissipation are summed.
#pragma once

#include "core/closures/clearance_joint.h"
#include "core/closures/replacement_joint.h"
#include "core/forces/constant_friction.h"
#include "core/forces/course_value.h"
#include "core/forces/end_stops.h"
#include "core/forces/point_springs.h"

namespace linkstudy {

template <class Real>
inline void add_drive(const LoadStructure& s, Real value, Velocities<const Real> v,
                      Workspace<Real>& w) {
  w.tau[s.v] = w.tau[s.v] + value;
  w.supplied_power = madd(value, v[s.v], w.supplied_power);
}

template <class Real>
inline void add_resistance(const LoadStructure& s, Real coefficient, Velocities<const Real> v,
                           Workspace<Real>& w) {
  const Real value = s.law == ResistanceShape::linear ? linear_resistance(v[s.v], coefficient)
                                                      : quadratic_resistance(v[s.v], coefficient);
  w.tau[s.v] = w.tau[s.v] - value;
  w.dissipated_power = madd(value, v[s.v], w.dissipated_power);
}

template <class Real>
inline void add_link_load(const LoadStructure& s, const LoadParameters<Real>& n, Real value,
                          Workspace<Real>& w, Wrench<Real>& load) {
  BodyState<Real>& b = w.bodies[s.body];
  const Vec3<Real> e = value * (s.follows_link ? b.R_WB * n.direction : n.direction);
  load = {e, zero3<Real>()};
  if (s.type == LoadType::link_force) load = {cross(b.R_WB * n.point, e), e};
  b.wrench.force = b.wrench.force - load.force;
  b.wrench.moment = b.wrench.moment - load.moment;
  w.supplied_power = w.supplied_power + dot(b.v_WB, load.force) + dot(b.w_WB, load.moment);
}

template <class Real>
inline void add_loads(const Mechanism& m, const Parameters<Real>& p, Real t,
                      Positions<const Real> q, Velocities<const Real> v, Workspace<Real>& w) {
  for (const LoadIndex i : indices_of(m.loads)) {
    const LoadStructure& s = m.loads[i];
    const LoadParameters<Real>& n = p.loads[i];
    if (s.type == LoadType::resistance) {
      add_resistance(s, n.resistance, v, w);
      continue;
    }
    const Real value = update_course(s.course, n.course, p.segments, t, q, w);
    if (s.type == LoadType::drive) {
      add_drive(s, value, v, w);
    } else {
      add_link_load(s, n, value, w, w.link_loads[i]);
    }
  }
}

// A curve beside the spring: tau = -curve(q).
template <class Real>
inline void add_joint_curve(const JointSpring& s, const JointSpringParameters<Real>& n,
                            const Segments<Real>& segments, Real q, Workspace<Real>& w) {
  w.tau[s.v] = w.tau[s.v] - curve_force(s.curve, n.curve, segments, q);
  w.spring_weights[s.bend] = abs(curve_slope(s.curve, segments, q));
}

// Springs and dampers of tree joints, such as the sdes of a flexible link ([AugUrb18] sec. 3):
// tau = -c (q - rest) - b v.
template <class Real>
inline void add_joint_springs(const Mechanism& m, const Parameters<Real>& p,
                              Positions<const Real> q, Velocities<const Real> v,
                              Workspace<Real>& w) {
  for (const JointSpringIndex i : indices_of(m.joint_springs)) {
    const JointSpring& s = m.joint_springs[i];
    const JointSpringParameters<Real>& n = p.joint_springs[i];
    const Real damping = n.damping * v[s.v];
    w.tau[s.v] = w.tau[s.v] - madd(n.stiffness, q[s.q] - n.rest, damping);
    if (s.bend.exists()) add_joint_curve(s, n, p.segments, q[s.q], w);
    w.dissipated_power = madd(damping, v[s.v], w.dissipated_power);
  }
}

// BodyState::wrench holds the inertial wrenches; the forces are taken off them.
template <class Real>
inline void update_applied_forces(const Mechanism& m, const Parameters<Real>& p, Real t,
                                  Positions<const Real> q, Velocities<const Real> v,
                                  Workspace<Real>& w) {
  for (const VelocityIndex k : velocities(m)) w.tau[k] = Real(0.0);
  w.supplied_power = Real(0.0);
  w.dissipated_power = w.contact_power = Real(0.0);
  add_loads(m, p, t, q, v, w);
  add_joint_springs(m, p, q, v, w);
  add_replacement_joints(m, p, w);
  add_point_springs(m, p, t, q, w);
  add_clearance_joints(m, p, w);
  add_stops(m, p, q, v, w);
  add_constant_friction(m, p, v, w);
}

}  // namespace linkstudy
