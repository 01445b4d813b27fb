// Redundant reactions shared by all joints of the loops. Reactions that balance a linkage are not
// unique where its joints hold a motion twice: self-stresses n, closure forces that no velocity
// feels (J^T n = 0), add to them, and only the compliance of joints and links decides. Taken here
// are those for which
//   sum over the joints of the loops of (l F)^2 + M^2
// is least, F and M the reaction (core/dynamics/reactions.h, core/closures/closure_wrench.h), M
// about the joint's point: the origin of the joint frame in the child, the closure point of
// `first`. l^2 is the mean of the squared distances of these points from their middle, one l for
// loops that have joints in common. So the result depends neither on which joint of a loop is cut,
// nor on the order of joints, nor on units or masses. Along the free directions of a joint n does
// nothing: drives, springs and resistances there are as they were.
//
// Joints inside a flexible link do not count, or its number of parts would decide; they bear what
// the others leave. The number of self-stresses is what the motion left of independent rows
// (Workspace::kept_rows), and idle rows, which a run does not have, are self-stresses as well.
// Accelerations do not depend on any of this, unless joint friction feels the reactions
// (core/dynamics/joint_friction.h).
#pragma once

#include "core/closures/closure_wrench.h"
#include "core/dynamics/reactions.h"
#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/null_space_fit.h"

namespace linkstudy {

// Joint points nearer to each other than this part of their coordinates are one point.
inline constexpr double kOnePoint = 1e-9;

template <class F>
inline void for_loop_joints(const Mechanism& m, F&& f) {
  const int count = static_cast<int>(m.loop_joints.size());
  for (int i = 0; i < count; ++i) f(i, at(m.loop_joints, i));
}
template <class F>
inline void for_loop_rows(const Mechanism& m, F&& f) {
  const int count = static_cast<int>(m.loop_rows.size());
  for (int r = 0; r < count; ++r) f(r, at(m.loop_rows, r));
}

// Where the reaction of a joint is taken.
template <class Real>
inline const Vec3<Real>& point_of(const Workspace<Real>& w, const LoopJoint& joint) {
  return joint.body >= 0 ? at(w.bodies, joint.body).p : at(w.closures, joint.closure).p1;
}

// l of the loops of one joint; 0 where all their joints are at one point.
template <class Real>
inline Real spread_of(const Mechanism& m, const Workspace<Real>& w, int group) {
  Vec3<Real> sum = zero3<Real>();
  Real count(0.0), square(0.0), extent(0.0);
  const auto for_points = [&](auto&& f) {
    for_loop_joints(m, [&](int, const LoopJoint& joint) {
      if (joint.counts && joint.group == group) f(point_of(w, joint));
    });
  };
  for_points([&](const Vec3<Real>& point) {
    sum = sum + point;
    count = count + Real(1.0);
    extent = max(extent, max(abs(point.x), max(abs(point.y), abs(point.z))));
  });
  const Vec3<Real> middle = (Real(1.0) / count) * sum;
  for_points([&](const Vec3<Real>& point) {
    const Vec3<Real> r = point - middle;
    square = square + dot(r, r);
  });
  const Real spread = sqrt(square / count);
  return select(spread > Real(kOnePoint) * extent, spread, Real(0.0));
}

// Loops without a length take the longest of the others, or 1 m; returns the longest.
template <class Real>
inline Real update_loop_lengths(const Mechanism& m, const Workspace<Real>& w,
                                SharedReactions<Real>& s) {
  Real longest(0.0);
  for_loop_joints(m, [&](int i, const LoopJoint& joint) {
    at(s.length, i) = spread_of(m, w, joint.group);
    longest = max(longest, at(s.length, i));
  });
  longest = select(longest > Real(0.0), longest, Real(1.0));
  for_loop_joints(m, [&](int i, const LoopJoint&) {
    at(s.length, i) = select(at(s.length, i) > Real(0.0), at(s.length, i), longest);
  });
  return longest;
}

// Unit wrenches of all rows, idle ones too.
template <class Real>
inline void update_loop_rows(const Mechanism& m, const Parameters<Real>& p,
                             const Workspace<Real>& w, SharedReactions<Real>& s) {
  for_loop_rows(m, [&](int r, const Row& row) {
    ClosureStructure c = at(m.closures, row.closure);
    ClosureState<Real> x = at(w.closures, row.closure);
    c.needs_frames = true;
    const ClosureParameters<Real>& n = at(p.closures, row.closure);
    update_closure_pose(m, c, n, w.bodies.data(), x);
    update_row(row, x, n, at(w.bodies, c.first), at(w.bodies, c.second), zero3<Real>(),
               at(s.rows, r));
  });
}

// J without units: rows over their scale, shifts in the longest length.
template <class Real>
inline void update_loop_jacobian(const Mechanism& m, const Parameters<Real>& p,
                                 const Workspace<Real>& w, Real longest, SharedReactions<Real>& s) {
  for_loop_rows(m, [&](int r, const Row& row) {
    Real& scale = at(s.row_scale, r);
    scale = longest;
    for_loop_joints(m, [&](int i, const LoopJoint& joint) {
      if (joint.closure == row.closure) scale = at(s.length, i);
    });
    if (row.kind == RowKind::rotation) scale = Real(1.0);
    Real* j = s.jacobian.data() + r * m.nv;
    for (int k = 0; k < m.nv; ++k) j[k] = Real(0.0);
    add_row_rates(m, p, w, row.closure, row, at(s.rows, r), j);
    for (int k = 0; k < m.nv; ++k) {
      const bool slides = at(m.velocities, k).kind == VelocityKind::translation;
      j[k] = (slides ? longest : Real(1.0)) * j[k] / scale;
    }
  });
}

// What a row with multiplier 1 changes in the reaction of a joint.
template <class Real>
inline Wrench<Real> effect_on(const Mechanism& m, const Workspace<Real>& w, const Row& row,
                              const RowState<Real>& state, const LoopJoint& joint) {
  const ClosureStructure& c = at(m.closures, row.closure);
  const ClosureState<Real>& x = at(w.closures, row.closure);
  const Vec3<Real>& point_1 = acts_at_both_points(row.kind) ? x.p1 : x.p2;
  Wrench<Real> effect{zero3<Real>(), zero3<Real>()};
  if (joint.closure >= 0) {
    if (joint.closure != row.closure) return effect;
    add_force(effect, point_1 - x.p1, state.force);
    effect.moment = effect.moment + state.couple;
    return effect;
  }
  const Vec3<Real>& origin = at(w.bodies, joint.body).p;
  const bool first = carries(m, joint.body, c.first), second = carries(m, joint.body, c.second);
  if (first == second) return effect;
  if (first) {
    subtract_force(effect, point_1 - origin, state.force);
    effect.moment = effect.moment - state.couple;
  } else {
    add_force(effect, x.p2 - origin, state.force);
    effect.moment = effect.moment + state.couple;
  }
  return effect;
}

// Effects of all rows without units, each lane for itself.
template <class Real>
inline void update_loop_effects(const Mechanism& m, const Workspace<Real>& w,
                                SharedReactions<Real>& s) {
  const int joints = static_cast<int>(m.loop_joints.size());
  for_loop_rows(m, [&](int r, const Row& row) {
    for_loop_joints(m, [&](int i, const LoopJoint& joint) {
      at(s.effect, r * joints + i) = effect_on(m, w, row, at(s.rows, r), joint);
    });
  });
}

// Lane i of a wrench times a factor as six numbers of one unit, and back.
template <class Real>
inline void write_lane(const Wrench<Real>& from, double length, double factor, int i, double* to) {
  to[0] = lane(from.force.x, i) * length * factor;
  to[1] = lane(from.force.y, i) * length * factor;
  to[2] = lane(from.force.z, i) * length * factor;
  to[3] = lane(from.moment.x, i) * factor;
  to[4] = lane(from.moment.y, i) * factor;
  to[5] = lane(from.moment.z, i) * factor;
}
template <class Real>
inline void read_lane(const double* from, double length, int i, Wrench<Real>& to) {
  set_lane(to.force.x, i, from[0] / length);
  set_lane(to.force.y, i, from[1] / length);
  set_lane(to.force.z, i, from[2] / length);
  set_lane(to.moment.x, i, from[3]);
  set_lane(to.moment.y, i, from[4]);
  set_lane(to.moment.z, i, from[5]);
}

template <class Real>
inline void reduce_lane(const Mechanism& m, int rank, int i, SharedReactions<Real>& s) {
  NullSpaceFit& fit = at(s.fits, i);
  const int joints = static_cast<int>(m.loop_joints.size());
  for_loop_rows(m, [&](int r, const Row&) {
    for (int k = 0; k < m.nv; ++k) {
      fit.jacobian()[r * m.nv + k] = lane(at(s.jacobian, r * m.nv + k), i);
    }
    const double unit = 1.0 / lane(at(s.row_scale, r), i);
    for (int n = 0; n < joints; ++n) {
      const int e = r * joints + n;
      write_lane(at(s.effect, e), lane(at(s.length, n), i), unit, i, fit.effects() + 6 * e);
    }
  });
  fit.reduce(rank);
}

template <class Real>
inline void fit_lane(const Mechanism& m, int i, SharedReactions<Real>& s) {
  NullSpaceFit& fit = at(s.fits, i);
  for_loop_joints(m, [&](int n, const LoopJoint&) {
    write_lane(at(s.borne, n), lane(at(s.length, n), i), 1.0, i, fit.given() + 6 * n);
  });
  fit.fit();
  for_loop_joints(m, [&](int n, const LoopJoint&) {
    read_lane(fit.change() + 6 * n, lane(at(s.length, n), i), i, at(s.change, n));
  });
}

// Self-stresses of a pose, after `update_cut_joints`.
template <class Real>
[[gnu::noinline]] void update_self_stresses(const Mechanism& m, const Parameters<Real>& p,
                                            const Workspace<Real>& w, SharedReactions<Real>& s) {
  const int rows = static_cast<int>(m.loop_rows.size());
  const auto rank_of = [&](int i) { return static_cast<int>(lane(w.kept_rows, i)); };
  s.redundant = 0;
  for (int i = 0; i < RealTraits<Real>::lanes; ++i)
    if (rank_of(i) < rows) s.redundant |= 1u << i;
  if (s.redundant == 0) return;
  const Real longest = update_loop_lengths(m, w, s);
  update_loop_rows(m, p, w, s);
  update_loop_jacobian(m, p, w, longest, s);
  update_loop_effects(m, w, s);
  for (int i = 0; i < RealTraits<Real>::lanes; ++i) {
    if ((s.redundant >> i & 1u) != 0) reduce_lane(m, rank_of(i), i, s);
  }
}

// Shares the reactions that `update_reactions` left, by the self-stresses of the pose; the shares
// of closures stay in `change`. Where nothing is redundant all keep their bits.
template <class Real, class R>
[[gnu::noinline]] void share_reactions(const Mechanism& m, const Workspace<Real>& w, R& reactions,
                                       SharedReactions<Real>& s) {
  const Real none(-0.0);  // added to a zero of either sign it leaves the sign
  const Vec3<Real> zero{none, none, none};
  for_loop_joints(m, [&](int i, const LoopJoint& joint) {
    at(s.change, i) = {zero, zero};
    if (joint.body >= 0) {
      at(s.borne, i) = at(reactions.on_child, joint.body);
      return;
    }
    const ClosureWrench<Real> f =
        compute_closure_wrench(at(m.closures, joint.closure), at(w.closures, joint.closure));
    at(s.borne, i) = {f.torque, f.force};
  });
  for (int i = 0; i < RealTraits<Real>::lanes; ++i) {
    if ((s.redundant >> i & 1u) != 0) fit_lane(m, i, s);
  }
  for_loop_joints(m, [&](int i, const LoopJoint& joint) {
    if (joint.body < 0) return;
    Wrench<Real>& f = at(reactions.on_child, joint.body);
    f.force = f.force + at(s.change, i).force;
    f.moment = f.moment + at(s.change, i).moment;
  });
}

// The wrench of a closure with its share.
template <class Real>
inline void add_shared(const Mechanism& m, int closure, const SharedReactions<Real>& s,
                       ClosureWrench<Real>& f) {
  for_loop_joints(m, [&](int i, const LoopJoint& joint) {
    if (joint.closure != closure) return;
    f.force = f.force + at(s.change, i).force;
    f.torque = f.torque + at(s.change, i).moment;
  });
}

}  // namespace linkstudy
