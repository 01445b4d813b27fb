// Force and torque of a closure on chain 1 at its closure point p1, ground axes, and the gap
// p2 - p1. Cut joints and sdes alike, from the sums of value times unit wrench; with clearance,
// the forces of the contacts too.
#pragma once

#include "core/model/workspace.h"

namespace linkstudy {

template <class Real>
struct ClosureWrench {
  Vec3<Real> force;   // N
  Vec3<Real> torque;  // N m, about p1
  Vec3<Real> gap;     // m
};

template <class Real>
inline ClosureWrench<Real> compute_closure_wrench(const ClosureStructure& c,
                                                  const ClosureState<Real>& x) {
  const Vec3<Real> gap = x.p2 - x.p1;
  ClosureWrench<Real> f{x.force_points + x.force_second, x.couple + cross(gap, x.force_second),
                        gap};
  if (c.model != ClosureModel::clearance) return f;
  f.force = f.force + x.contact_force;
  f.torque = f.torque + x.contact_moment;
  return f;
}

}  // namespace linkstudy
