// Directions of a closure: displacement d, its rate, its second derivative for qdd = 0, and its
// unit wrench ([Urbas16] eqs. (6)-(14), (18.3)). A closure force of size f puts +f times the unit
// wrench on the first body and -f times it on the second. gap = p_WS - p_WF.
//
//   ground axis e     d = e.gap    force e, at F on the first body and at S on the second
//   axis e of {1,e}   d = e.gap    force e at S on both (e turns with body 1)
//   line of centres   d = |gap| - length of a rod, else 0; force u along the line, zero where the
//                     points coincide
//   rotation          d = s a.b    couple s b x a
//   rotation vector   d = e.phi    couple d phi_i / d(turn) (core/spatial/rotation_vector.h)
#pragma once

#include "core/kinematics/forward_kinematics.h"
#include "core/spatial/rotation_vector.h"

namespace linkstudy {

template <class Real>
inline Real component(const Vec3<Real>& a, int i) {
  return i == 0 ? a.x : i == 1 ? a.y : a.z;
}

// True where the force acts at F on the first body (and at S on the second), not at S on both.
inline bool acts_at_both_points(RowKind kind) {
  return kind == RowKind::translation_ground || kind == RowKind::spring_ground;
}

template <class Real>
inline void update_closure_pose(const Mechanism& m, const ClosureStructure& c,
                                const ClosureParameters<Real>& n, const BodyStates<Real>& bodies,
                                ClosureState<Real>& x) {
  const BodyState<Real>& b1 = bodies[c.first];
  const BodyState<Real>& b2 = bodies[c.second];
  x.p_BF_W = rotate(b1.R_WB, n.point_1, c.point_1);
  x.p_BS_W = rotate(b2.R_WB, n.point_2, c.point_2);
  x.p_WF = b1.p_WB + x.p_BF_W;
  x.p_WS = b2.p_WB + x.p_BS_W;
  x.v_WF = b1.v_WB;
  x.v_WS = b2.v_WB;
  const bool turns_1 = m.bodies[c.first].rotates;
  const bool turns_2 = m.bodies[c.second].rotates;
  if (turns_1) x.v_WF = x.v_WF + cross(b1.w_WB, x.p_BF_W);
  if (turns_2) x.v_WS = x.v_WS + cross(b2.w_WB, x.p_BS_W);
  if (!c.needs_frames) return;
  x.R_WF = b1.R_WB * n.frame_1;
  x.R_WS = b2.R_WB * n.frame_2;
}

// Acceleration for qdd = 0, less gravity, of a point `arm` from the origin that moves with v.
template <class Real>
inline Vec3<Real> point_acceleration(const Body& body, const BodyState<Real>& b,
                                     const Vec3<Real>& arm, const Vec3<Real>& v) {
  if (!body.rotates) return b.a_WB;
  const Vec3<Real> a = b.a_WB + cross(b.w_WB, v - b.v_WB);
  return body.gyrates ? a + cross(b.alpha_WB, arm) : a;
}

// a2 - a1 of the closure points for qdd = 0.
template <class Real>
inline Vec3<Real> gap_acceleration(const Mechanism& m, const ClosureStructure& c,
                                   const BodyStates<Real>& bodies, const ClosureState<Real>& x) {
  return point_acceleration(m.bodies[c.second], bodies[c.second], x.p_BS_W, x.v_WS) -
         point_acceleration(m.bodies[c.first], bodies[c.first], x.p_BF_W, x.v_WF);
}

// Gap, its rate and acceleration seen from a frame that turns with the first body.
template <class Real>
struct TurningGap {
  Vec3<Real> gap, rate, acceleration;
};

template <class Real>
inline TurningGap<Real> gap_seen_from_first(const BodyState<Real>& b1, const ClosureState<Real>& x,
                                            const Vec3<Real>& acceleration) {
  const Vec3<Real> gap = x.p_WS - x.p_WF;
  const Vec3<Real> carried = cross(b1.w_WB, gap);
  const Vec3<Real> rate = x.v_WS - x.v_WF - carried;
  return {gap, rate,
          acceleration - cross(b1.alpha_WB, gap) - cross(b1.w_WB, madd(Real(2.0), rate, carried))};
}

template <class Real>
inline void update_line_row(const ClosureState<Real>& x, Real rod, const Vec3<Real>& acceleration,
                            RowState<Real>& row) {
  const Vec3<Real> gap = x.p_WS - x.p_WF;
  const Real length = sqrt(dot(gap, gap));
  const auto coincident = length < Real(1e-150);
  const Real one(1.0), none(0.0);
  const Real inverse = select(coincident, none, one / select(coincident, one, length));
  const Vec3<Real> speed = x.v_WS - x.v_WF;
  row.force = inverse * gap;
  row.d = length - rod;
  row.rate = dot(row.force, speed);
  // What moves across the line turns it.
  row.bias =
      madd(inverse, nmadd(row.rate, row.rate, dot(speed, speed)), dot(row.force, acceleration));
}

template <class Real>
inline void update_rotation_row(const Row& r, const ClosureState<Real>& x,
                                const BodyState<Real>& b1, const BodyState<Real>& b2,
                                RowState<Real>& row) {
  const Vec3<Real>& a = column(x.R_WF, r.axis);
  const Vec3<Real>& b = column(x.R_WS, r.other);
  const Real sign(r.sign);
  const Vec3<Real> omega = b2.w_WB - b1.w_WB;
  const Vec3<Real> rate = cross(cross(b2.w_WB, b), a) + cross(b, cross(b1.w_WB, a));
  row.couple = sign * cross(b, a);
  row.d = sign * dot(a, b);
  row.rate = dot(row.couple, omega);
  row.bias = dot(row.couple, b2.alpha_WB - b1.alpha_WB) + sign * dot(rate, omega);
}

template <class Real>
inline void update_rotation_vector_row(const Row& r, const ClosureState<Real>& x,
                                       const BodyState<Real>& b1, const BodyState<Real>& b2,
                                       RowState<Real>& row) {
  const RotationVector<Real> turn = rotation_vector(x.R_WF, x.R_WS);
  const Mat3<Real> e = identity3<Real>();
  row.couple = x.R_WF * rotation_vector_gradient(turn, column(e, r.axis));
  row.d = component(turn.phi, r.axis);
  row.rate = dot(row.couple, b2.w_WB - b1.w_WB);
  row.bias = Real(0.0);  // never a constraint
}

// One row; `acceleration` is gap_acceleration, used for the bias only.
template <class Real>
inline void update_row(const Row& r, const ClosureState<Real>& x, const ClosureParameters<Real>& n,
                       const BodyState<Real>& b1, const BodyState<Real>& b2,
                       const Vec3<Real>& acceleration, RowState<Real>& row) {
  switch (r.kind) {
    case RowKind::translation_ground:
      row.d = component(x.p_WS, r.axis) - component(x.p_WF, r.axis);
      row.rate = component(x.v_WS, r.axis) - component(x.v_WF, r.axis);
      row.bias = component(acceleration, r.axis);
      return;
    case RowKind::spring_ground:
      row.force = column(n.springs, r.axis);
      row.d = dot(row.force, x.p_WS - x.p_WF);
      row.rate = dot(row.force, x.v_WS - x.v_WF);
      row.bias = dot(row.force, acceleration);
      return;
    case RowKind::translation_first:
    case RowKind::spring_first: {
      const bool spring = r.kind == RowKind::spring_first;
      row.force = spring ? x.R_WF * column(n.springs, r.axis) : column(x.R_WF, r.axis);
      const TurningGap<Real> seen = gap_seen_from_first(b1, x, acceleration);
      row.d = dot(row.force, seen.gap);
      row.rate = dot(row.force, seen.rate);
      row.bias = dot(row.force, seen.acceleration);
      return;
    }
    case RowKind::line_of_centres:
      return update_line_row(x, n.length, acceleration, row);
    case RowKind::rotation:
      return update_rotation_row(r, x, b1, b2, row);
    case RowKind::rotation_vector:
      return update_rotation_vector_row(r, x, b1, b2, row);
    case RowKind::coupling_turn:
    case RowKind::coupling_shift:
      return;  // core/kinematics/forward_kinematics.h
  }
}

// The three ground axes at once, x y z in this order.
template <class Real>
inline void update_point_rows(const ClosureState<Real>& x, const Vec3<Real>& acceleration,
                              RowState<Real>* rows) {
  rows[0].d = x.p_WS.x - x.p_WF.x;
  rows[1].d = x.p_WS.y - x.p_WF.y;
  rows[2].d = x.p_WS.z - x.p_WF.z;
  rows[0].rate = x.v_WS.x - x.v_WF.x;
  rows[1].rate = x.v_WS.y - x.v_WF.y;
  rows[2].rate = x.v_WS.z - x.v_WF.z;
  rows[0].bias = acceleration.x;
  rows[1].bias = acceleration.y;
  rows[2].bias = acceleration.z;
}

template <RowStorage Storage>
inline const auto& rows_of(const Mechanism& m) {
  if constexpr (Storage == RowStorage::cut) {
    return m.cut_rows;
  } else {
    return m.sde_rows;
  }
}
template <RowStorage Storage, class W>
inline auto& row_states_of(W& w) {
  if constexpr (Storage == RowStorage::cut) {
    return w.cut_rows;
  } else {
    return w.sde_rows;
  }
}

// Rows of all closures of one model.
template <RowStorage Storage, class Real>
inline void update_rows(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  const auto& rows = rows_of<Storage>(m);
  auto& states = row_states_of<Storage>(w);
  const BodyStates<Real>& bodies = w.bodies;
  for (const ClosureIndex i : indices_of(m.closures)) {
    const ClosureStructure& c = m.closures[i];
    if (storage_of(c.model) != Storage) continue;
    ClosureState<Real>& x = w.closures[i];
    update_closure_pose(m, c, p.closures[i], bodies, x);
    const Vec3<Real> acceleration =
        Storage == RowStorage::cut ? gap_acceleration(m, c, bodies, x) : zero3<Real>();
    if (c.point_rows) update_point_rows(x, acceleration, &states[c.row_begin]);
    for (const RowIndex r : other_rows_of(c)) {
      update_row(rows[r], x, p.closures[i], bodies[c.first], bodies[c.second], acceleration,
                 states[r]);
    }
  }
}

template <class Real>
inline void add_row_force(const Row& structure, const RowState<Real>& row, ClosureState<Real>& x) {
  switch (structure.kind) {
    case RowKind::translation_ground:
      if (structure.axis == 0) x.force_points.x = x.force_points.x + row.value;
      if (structure.axis == 1) x.force_points.y = x.force_points.y + row.value;
      if (structure.axis == 2) x.force_points.z = x.force_points.z + row.value;
      return;
    case RowKind::spring_ground:
      x.force_points = madd(row.value, row.force, x.force_points);
      return;
    case RowKind::rotation:
    case RowKind::rotation_vector:
      x.couple = madd(row.value, row.couple, x.couple);
      return;
    default:
      x.force_second = madd(row.value, row.force, x.force_second);
  }
}

// Sums of value times unit wrench over the rows of every closure of one model, for the bodies and
// for output.
template <RowStorage Storage, class Real>
inline void sum_row_forces(const Mechanism& m, Workspace<Real>& w) {
  const auto& rows = rows_of<Storage>(m);
  const auto& states = row_states_of<Storage>(w);
  for (const ClosureIndex i : indices_of(m.closures)) {
    const ClosureStructure& c = m.closures[i];
    if (storage_of(c.model) != Storage) continue;
    ClosureState<Real>& x = w.closures[i];
    x.force_points = x.force_second = x.couple = zero3<Real>();
    if (c.point_rows) {
      x.force_points = {states[c.row_begin].value, states[c.row_begin + 1].value,
                        states[c.row_begin + 2].value};
    }
    for (const RowIndex r : other_rows_of(c)) add_row_force(rows[r], states[r], x);
  }
}

// Adds the forces of a clearance's contacts, times -1, to the wrenches that the bodies need.
template <class Real>
inline void subtract_contact_forces(const ClosureStructure& c, const ClosureState<Real>& x,
                                    const BodyStates<Real>& bodies, Wrench<Real>& first,
                                    Wrench<Real>& second) {
  subtract_force(first, x.p_BF_W, x.contact_force);
  add_force(second, x.p_WF - bodies[c.second].p_WB, x.contact_force);
  first.moment = first.moment - x.contact_moment;
  second.moment = second.moment + (x.contact_moment - x.contact_surplus);
}

// Adds the closure's forces, times -1, to the wrenches that the bodies need: +f on the first body,
// -f on the second.
template <class Real>
inline void subtract_closure_forces(const ClosureStructure& c, const ClosureState<Real>& x,
                                    const BodyStates<Real>& bodies, Wrench<Real>& first,
                                    Wrench<Real>& second) {
  subtract_force(first, x.p_BF_W, x.force_points);
  add_force(second, x.p_BS_W, x.force_points);
  if (!c.needs_frames && !c.has_line) return;
  subtract_force(first, x.p_WS - bodies[c.first].p_WB, x.force_second);
  add_force(second, x.p_BS_W, x.force_second);
  first.moment = first.moment - x.couple;
  second.moment = second.moment + x.couple;
}

}  // namespace linkstudy
