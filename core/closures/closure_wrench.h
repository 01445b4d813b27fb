// Force and torque of a closure on chain 1 at its closure point F, ground axes, and the gap
// p_WS - p_WF, of a rod what that is longer than the rod. Cut joints and sdes alike, from the sums
// of value times unit wrench; with clearance, the forces of the contacts too.
#pragma once

#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

template <class Real>
struct ClosureWrench {
  Vec3<Real> force;   // N
  Vec3<Real> torque;  // N m, about F
};

template <class Real>
inline ClosureWrench<Real> compute_closure_wrench(const ClosureStructure& c,
                                                  const ClosureState<Real>& x) {
  ClosureWrench<Real> f{x.force_points + x.force_second,
                        x.couple + cross(x.p_WS - x.p_WF, x.force_second)};
  if (c.model != ClosureModel::clearance) return f;
  f.force = f.force + x.contact_force;
  f.torque = f.torque + x.contact_moment;
  return f;
}

// m
template <class Real>
inline Vec3<Real> closure_gap(const ClosureStructure& c, const ClosureParameters<Real>& n,
                              const ClosureState<Real>& x) {
  const Vec3<Real> way = x.p_WS - x.p_WF;
  if (!c.is_rod) return way;
  return (Real(1.0) - n.length / sqrt(dot(way, way))) * way;
}

}  // namespace linkstudy
