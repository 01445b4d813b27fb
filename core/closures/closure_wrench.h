// Force and torque of a closure on chain 1 at its closure point p1, ground axes, and the gap
// p2 - p1. Cut joints and sdes alike: the sum of row value times unit wrench.
#pragma once

#include "core/kinematics/closure_kinematics.h"

namespace linkstudy {

template <class Real>
struct ClosureWrench {
  Vec3<Real> force;   // N
  Vec3<Real> torque;  // N m, about p1
  Vec3<Real> gap;     // m
};

template <class Real>
inline const RowState<Real>* rows_of(const ClosureStructure& c, const Workspace<Real>& w) {
  return c.model == ClosureModel::cut ? w.cut_rows.data() : w.sde_rows.data();
}

template <class Real>
inline ClosureWrench<Real> compute_closure_wrench(const Mechanism& m, const Parameters<Real>& p,
                                                  const Workspace<Real>& w, int closure) {
  const auto i = static_cast<std::size_t>(closure);
  const ClosureStructure& c = m.closures[i];
  const BodyState<Real>& b1 = w.bodies[static_cast<std::size_t>(c.first)];
  const BodyState<Real>& b2 = w.bodies[static_cast<std::size_t>(c.second)];
  const Vec3<Real> p1 = b1.p + b1.r * p.closures[i].point_1;
  const Vec3<Real> p2 = b2.p + b2.r * p.closures[i].point_2;
  Force<Real> sum{zero3<Real>(), zero3<Real>()};
  const RowState<Real>* rows = rows_of(c, w);
  for (int r = c.row_begin; r < c.row_end; ++r) sum = madd(rows[r].value, rows[r].w1, sum);
  return {sum.force, sum.moment - cross(p1, sum.force), p2 - p1};
}

}  // namespace linkstudy
