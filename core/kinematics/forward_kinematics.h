// Poses, velocities, qdd-free accelerations, axes and inertias of all bodies, ground to tips, and
// the rows of couplings.
// X_WB = X_WP X_PJ X_J(q); gravity enters as an acceleration -g of the ground.
#pragma once

#include "core/kinematics/joint_kinematics.h"
#include "core/model/parameters.h"
#include "core/model/walk.h"
#include "core/model/workspace.h"

namespace linkstudy {

// R a for a constant vector a of known shape.
template <class Real>
inline Vec3<Real> rotate(const Mat3<Real>& r, const Vec3<Real>& a, VectorShape shape) {
  switch (shape) {
    case VectorShape::along_x:
      return a.x * r.x;
    case VectorShape::along_y:
      return a.y * r.y;
    case VectorShape::along_z:
      return a.z * r.z;
    case VectorShape::zero:
      return zero3<Real>();
    case VectorShape::general:
      break;
  }
  return r * a;
}

template <class Real>
inline const Vec3<Real>& column(const Mat3<Real>& m, int i) {
  return i == 0 ? m.x : i == 1 ? m.y : m.z;
}

template <class Real>
inline Vec3<Real> signed_column(const Mat3<Real>& m, int axis, int sign) {
  const Vec3<Real>& a = column(m, axis);
  return sign > 0 ? a : Real(-1.0) * a;
}

template <class Real>
inline void turn_frame(const Body& body, const Mat3<Real>& parent, const Mat3<Real>& frame,
                       Mat3<Real>& r) {
  if (body.frame == RotationShape::identity) {
    r = parent;
  } else if (body.frame == RotationShape::general) {
    r = parent * frame;
  } else {
    const QuarterTurn& t = body.quarter;
    r.x = signed_column(parent, t.axis[0], t.sign[0]);
    r.y = signed_column(parent, t.axis[1], t.sign[1]);
    r.z = signed_column(parent, t.axis[2], t.sign[2]);
  }
}

// Joint frame in the parent, before the joint moves.
template <class Real>
inline Moving<Real> start_at_joint_frame(const Body& body, const BodyParameters<Real>& n,
                                         const BodyState<Real>& parent, const Body& parent_body,
                                         BodyState<Real>& s) {
  s.v_WB = parent.v_WB;
  s.a_WB = parent.a_WB;
  if (body.parent == kGroundBody) {
    s.R_WB = n.R_PJ;
    s.p_WB = n.p_PJ;
    return {s, false, false};
  }
  turn_frame(body, parent.R_WB, n.R_PJ, s.R_WB);
  s.p_WB = parent.p_WB;
  if (parent_body.rotates) s.w_WB = parent.w_WB;
  if (parent_body.gyrates) s.alpha_WB = parent.alpha_WB;
  if (body.offset != VectorShape::zero) {
    const Vec3<Real> r = rotate(parent.R_WB, n.p_PJ, body.offset);
    s.p_WB = s.p_WB + r;
    if (parent_body.rotates) {
      const Vec3<Real> carried = cross(s.w_WB, r);
      s.v_WB = s.v_WB + carried;
      s.a_WB = s.a_WB + cross(s.w_WB, carried);
      if (parent_body.gyrates) s.a_WB = s.a_WB + cross(s.alpha_WB, r);
    }
  }
  return {s, parent_body.rotates, parent_body.gyrates};
}

template <class Real>
inline Sym3<Real> world_inertia(InertiaShape shape, const Sym3<Real>& i, const Mat3<Real>& r) {
  switch (shape) {
    case InertiaShape::isotropic:
      return {i.xx, i.xx, i.xx, Real(0.0), Real(0.0), Real(0.0)};
    case InertiaShape::about_x:
      return axisymmetric(i.yy, i.xx - i.yy, r.x);
    case InertiaShape::about_y:
      return axisymmetric(i.xx, i.yy - i.xx, r.y);
    case InertiaShape::about_z:
      return axisymmetric(i.xx, i.zz - i.xx, r.z);
    case InertiaShape::general:
      break;
  }
  return rotate(r, i);
}

template <class Real>
inline void set_ground(const Parameters<Real>& p, BodyState<Real>& ground) {
  const Vec3<Real> zero = zero3<Real>();
  ground.R_WB = identity3<Real>();
  ground.p_WB = ground.p_PB_W = ground.w_WB = ground.v_WB = ground.alpha_WB = zero;
  ground.a_WB = Real(-1.0) * p.gravity;
}

// Rows of couplings; accelerations that are known are part of the bias.
template <class Real>
inline void update_coupling_rows(const Mechanism& m, const Parameters<Real>& p,
                                 Positions<const Real> q, Velocities<const Real> v,
                                 Workspace<Real>& w) {
  for (const CouplingIndex i : indices_of(m.couplings)) {
    const CouplingStructure& c = m.couplings[i];
    RowState<Real>& row = w.cut_rows[c.row];
    row.d = Real(0.0) - p.coupling_offsets[i];
    row.rate = row.bias = Real(0.0);
    for (const TermIndex n : terms_of(c)) {
      const CouplingTermStructure& term = m.coupling_terms[n];
      const Real& factor = p.coupling_factors[n];
      row.d = madd(factor, q[term.q], row.d);
      row.rate = madd(factor, v[term.v], row.rate);
      const MotionIndex motion = m.velocities[term.v].motion;
      if (motion.exists()) row.bias = madd(factor, w.motions[motion].a, row.bias);
    }
  }
}

template <class Real>
inline void update_kinematics(const Mechanism& m, const Parameters<Real>& p,
                              Positions<const Real> q, Velocities<const Real> v,
                              Workspace<Real>& w) {
  set_ground(p, w.bodies[kGroundBody]);
  for (const BodyIndex b : bodies_outwards(m)) {
    const Body& body = m.bodies[b];
    const BodyParameters<Real>& n = p.bodies[b];
    const BodyState<Real>& parent = w.bodies[body.parent];
    BodyState<Real>& s = w.bodies[b];
    Moving<Real> x = start_at_joint_frame(body, n, parent, m.bodies[body.parent], s);
    for (const StageIndex i : stages_of(body)) {
      const Stage& stage = m.stages[i];
      pass_stage(stage, p.pitch[i], &q[stage.q], &v[stage.v], x, &w.axes[stage.v]);
      const Velocity& velocity = m.velocities[stage.v];
      if (velocity.motion.exists()) {
        accelerate(velocity.kind, p.pitch[i], w.motions[velocity.motion].a, w.axes[stage.v], x);
      }
    }
    if (body.shifted) s.p_PB_W = s.p_WB - parent.p_WB;
    s.inertia.m = n.mass;
    s.inertia.h = rotate(s.R_WB, n.moment, body.center);
    if (body.rotates) s.inertia.i = world_inertia(body.inertia, n.inertia, s.R_WB);
  }
  update_coupling_rows(m, p, q, v, w);
}

}  // namespace linkstudy
