// Directions of a closure: displacement d, its rate, its second derivative for qdd = 0, and its
// unit wrench ([Urbas16] eqs. (6)-(14), (18.3)). With w1 the wrench of d on the first body and w2
// on the second, d_dot = w2 . V2 - w1 . V1; a closure force of size f puts +f w1 on the first body
// and -f w2 on the second. Wrenches are about O.
//
//   ground axis e     d = e.(p2 - p1)   w1 = e at p1, w2 = e at p2
//   axis e of {1,e}   d = e.(p2 - p1)   w1 = w2 = e at p2 (e turns with body 1)
//   line of centres   d = |p2 - p1|     w1 = w2 = u, along the line; zero at coincidence
//   rotation          d = s a.b         w1 = w2 = torque s b x a
#pragma once

#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

// Closure points and frames in ground, shared by the rows of one closure.
template <class Real>
struct ClosurePose {
  Vec3<Real> p1, p2;
  Mat3<Real> r1, r2;
};

template <class Real>
inline ClosurePose<Real> closure_pose(const ClosureStructure& c, const ClosureParameters<Real>& n,
                                      const BodyState<Real>* bodies) {
  const BodyState<Real>& b1 = bodies[c.first];
  const BodyState<Real>& b2 = bodies[c.second];
  return {b1.p + b1.r * n.point_1, b2.p + b2.r * n.point_2, b1.r * n.frame_1, b2.r * n.frame_2};
}

template <class Real>
inline const Vec3<Real>& column(const Mat3<Real>& m, int i) {
  return i == 0 ? m.x : i == 1 ? m.y : m.z;
}

template <class Real>
inline Vec3<Real> ground_axis(int i) {
  const Real o(0.0), e(1.0);
  return {i == 0 ? e : o, i == 1 ? e : o, i == 2 ? e : o};
}

template <class Real>
inline Force<Real> line_force(const Vec3<Real>& p, const Vec3<Real>& e) {
  return {cross(p, e), e};
}

// A direction fixed in the ground.
template <class Real>
inline void update_ground_row(const ClosurePose<Real>& x, const Vec3<Real>& e,
                              const BodyState<Real>& b1, const BodyState<Real>& b2,
                              RowState<Real>& row) {
  row.w1 = line_force(x.p1, e);
  row.w2 = line_force(x.p2, e);
  row.d = dot(e, x.p2 - x.p1);
  row.rate = dot(e, velocity_at(b2.v, x.p2) - velocity_at(b1.v, x.p1));
  row.bias = dot(e, acceleration_at(b2.a, b2.v, x.p2) - acceleration_at(b1.a, b1.v, x.p1));
}

// A direction e fixed in the first body: d_dot = w . (V2 - V1), w = e at p2.
template <class Real>
inline void update_moving_row(const ClosurePose<Real>& x, const Vec3<Real>& e,
                              const BodyState<Real>& b1, const BodyState<Real>& b2,
                              RowState<Real>& row) {
  const Vec3<Real> e_rate = cross(b1.v.angular, e);
  const Motion<Real> v = b2.v - b1.v;
  row.w1 = row.w2 = line_force(x.p2, e);
  const Force<Real> w_rate{cross(velocity_at(b2.v, x.p2), e) + cross(x.p2, e_rate), e_rate};
  row.d = dot(e, x.p2 - x.p1);
  row.rate = dot(v, row.w1);
  row.bias = dot(b2.a - b1.a, row.w1) + dot(v, w_rate);
}

template <class Real>
inline void update_line_row(const ClosurePose<Real>& x, const BodyState<Real>& b1,
                            const BodyState<Real>& b2, RowState<Real>& row) {
  const Vec3<Real> gap = x.p2 - x.p1;
  const Real length = sqrt(dot(gap, gap));
  const auto coincident = length < Real(1e-150);
  const Real inverse =
      select(coincident, Real(0.0), Real(1.0) / select(coincident, Real(1.0), length));
  row.w1 = row.w2 = line_force(x.p2, inverse * gap);
  row.d = length;
  row.rate = dot(b2.v - b1.v, row.w1);
  row.bias = Real(0.0);  // never a constraint
}

template <class Real>
inline void update_rotation_row(const Vec3<Real>& a, const Vec3<Real>& b, Real sign,
                                const BodyState<Real>& b1, const BodyState<Real>& b2,
                                RowState<Real>& row) {
  const Vec3<Real> n = sign * cross(b, a);
  const Vec3<Real> n_rate =
      sign * (cross(cross(b2.v.angular, b), a) + cross(b, cross(b1.v.angular, a)));
  const Vec3<Real> omega = b2.v.angular - b1.v.angular;
  row.w1 = row.w2 = {n, zero3<Real>()};
  row.d = sign * dot(a, b);
  row.rate = dot(n, omega);
  row.bias = dot(n, b2.a.angular - b1.a.angular) + dot(n_rate, omega);
}

template <class Real>
inline void update_row(const Row& r, const ClosurePose<Real>& x, const Mat3<Real>& springs,
                       const BodyState<Real>& b1, const BodyState<Real>& b2, RowState<Real>& row) {
  switch (r.kind) {
    case RowKind::translation_ground:
      return update_ground_row(x, ground_axis<Real>(r.axis), b1, b2, row);
    case RowKind::translation_first:
      return update_moving_row(x, column(x.r1, r.axis), b1, b2, row);
    case RowKind::spring_ground:
      return update_ground_row(x, column(springs, r.axis), b1, b2, row);
    case RowKind::spring_first:
      return update_moving_row(x, x.r1 * column(springs, r.axis), b1, b2, row);
    case RowKind::line_of_centres:
      return update_line_row(x, b1, b2, row);
    case RowKind::rotation:
      return update_rotation_row(column(x.r1, r.axis), column(x.r2, r.other), Real(r.sign), b1, b2,
                                 row);
  }
}

// Rows of all closures of one list (Mechanism::cut_rows or sde_rows).
template <class Real>
inline void update_rows(const Mechanism& m, const Parameters<Real>& p, ClosureModel model,
                        Workspace<Real>& w) {
  const bool cut = model == ClosureModel::cut;
  const Row* rows = cut ? m.cut_rows.data() : m.sde_rows.data();
  RowState<Real>* states = cut ? w.cut_rows.data() : w.sde_rows.data();
  for (std::size_t i = 0; i < m.closures.size(); ++i) {
    const ClosureStructure& c = m.closures[i];
    if (c.model != model) continue;
    const ClosurePose<Real> x = closure_pose(c, p.closures[i], w.bodies.data());
    for (int r = c.row_begin; r < c.row_end; ++r) {
      update_row(rows[r], x, p.closures[i].springs, w.bodies[static_cast<std::size_t>(c.first)],
                 w.bodies[static_cast<std::size_t>(c.second)], states[r]);
    }
  }
}

}  // namespace linkstudy
