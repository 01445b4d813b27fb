// Springs, dampers and actuators along the line between two points. With p1 and p2 the points of
// the first and the second body, l = |p2 - p1|, e = (p2 - p1) / l, l' = e . (v2 - v1),
//   f = f_s(l, l') + f_u(t, q)   +f e acts on the first body at p1, -f e on the second at p2
// f_s of spring and damper (core/laws/spring_force.h), f_u of the actuator; both positive where
// they pull the points together. The power that leaves the bodies is f l': of f_s the elastic part
// is stored and the rest dissipated, -f_u l' is supplied. Where the points coincide e = 0: the line
// has no direction, and nothing acts.
#pragma once

#include "core/forces/course_value.h"
#include "core/forces/force_curve.h"
#include "core/laws/spring_force.h"
#include "core/model/walk.h"
#include "core/model/workspace.h"

namespace linkstudy {

// Velocity of a point `arm` from the origin of its body.
template <class Real>
inline Vec3<Real> velocity_at(const Body& body, const BodyState<Real>& b, const Vec3<Real>& arm) {
  return body.rotates ? b.v_WB + cross(b.w_WB, arm) : b.v_WB;
}

// Arms, length and rate; e is returned.
template <class Real>
inline Vec3<Real> update_line(const Mechanism& m, const PointSpringStructure& s,
                              const PointSpringParameters<Real>& n, const BodyStates<Real>& bodies,
                              PointSpringState<Real>& x) {
  const BodyState<Real>& b1 = bodies[s.first];
  const BodyState<Real>& b2 = bodies[s.second];
  x.arm_1 = b1.R_WB * n.point_1;
  x.arm_2 = b2.R_WB * n.point_2;
  const Vec3<Real> gap = (b2.p_WB + x.arm_2) - (b1.p_WB + x.arm_1);
  x.length = sqrt(dot(gap, gap));
  const auto coincide = x.length < Real(1e-150);
  const Real one(1.0), none(0.0);
  const Vec3<Real> e = select(coincide, none, one / select(coincide, one, x.length)) * gap;
  x.rate = dot(e, velocity_at(m.bodies[s.second], b2, x.arm_2) -
                      velocity_at(m.bodies[s.first], b1, x.arm_1));
  return e;
}

// How far a spring is stretched, or an elastic force of the same sign, which is where it acts.
template <class Real>
inline Real spring_stretch(const PointSpringStructure& s, const PointSpringParameters<Real>& n,
                           const Segments<Real>& segments, Real length) {
  return s.curve.is_linear() ? length - n.free_length
                             : curve_force(s.curve, n.curve, segments, length);
}

// d f_e / d l.
template <class Real>
inline Real spring_slope(const PointSpringStructure& s, const PointSpringParameters<Real>& n,
                         const Segments<Real>& segments, Real length, Real stretch) {
  if (!s.curve.is_linear()) return curve_slope(s.curve, segments, length);
  return select(is_acting(s.acts, stretch), n.stiffness, Real(0.0));
}

template <class Real>
inline Real point_spring_energy(const PointSpringStructure& s, const PointSpringParameters<Real>& n,
                                const Segments<Real>& segments, Real length) {
  if (!s.curve.is_linear()) return curve_energy(s.curve, n.curve, segments, length);
  const Real d = acting_part(s.acts, length - n.free_length);
  return Real(0.5) * n.stiffness * d * d;
}

template <class Real>
inline void subtract_spring_force(const PointSpringState<Real>& x, Wrench<Real>& first,
                                  Wrench<Real>& second) {
  subtract_force(first, x.arm_1, x.pull);
  add_force(second, x.arm_2, x.pull);
}

template <class Real>
inline void add_point_spring(const Mechanism& m, const Parameters<Real>& p, PointSpringIndex i,
                             Real t, Positions<const Real> q, Workspace<Real>& w) {
  const PointSpringStructure& s = m.point_springs[i];
  const PointSpringParameters<Real>& n = p.point_springs[i];
  PointSpringState<Real>& x = w.point_springs[i];
  const Segments<Real>& segments = p.segments;
  const Vec3<Real> e = update_line(m, s, n, w.bodies, x);
  const Real stretch = spring_stretch(s, n, segments, x.length);
  x.elastic = s.curve.is_linear() ? n.stiffness * acting_part(s.acts, stretch) : stretch;
  x.force = spring_force(s.acts, x.elastic, n.damping * x.rate, stretch);
  w.dissipated_power = madd(x.force - x.elastic, x.rate, w.dissipated_power);
  if (s.is_driven) {
    const Real actuator = update_course(s.course, n.course, segments, t, q, w);
    x.force = x.force + actuator;
    w.supplied_power = nmadd(actuator, x.rate, w.supplied_power);
  }
  x.pull = x.force * e;
  subtract_spring_force(x, w.bodies[s.first].wrench, w.bodies[s.second].wrench);
  if (!s.bend.exists()) return;
  const Real damping = select(is_acting(s.acts, stretch), n.damping, Real(0.0));
  w.spring_weights[s.bend] = abs(spring_slope(s, n, segments, x.length, stretch)) + damping;
}

template <class Real>
inline void add_point_springs(const Mechanism& m, const Parameters<Real>& p, Real t,
                              Positions<const Real> q, Workspace<Real>& w) {
  for (const PointSpringIndex i : indices_of(m.point_springs)) add_point_spring(m, p, i, t, q, w);
}

}  // namespace linkstudy
