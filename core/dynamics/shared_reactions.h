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
  for (const LoopJointIndex i : indices_of(m.loop_joints)) f(i, m.loop_joints[i]);
}
template <class F>
inline void for_loop_rows(const Mechanism& m, F&& f) {
  for (const LoopRowIndex r : indices_of(m.loop_rows)) f(r, m.loop_rows[r]);
}

// Where the reaction of a joint is taken.
template <class Real>
inline const Vec3<Real>& point_of(const Workspace<Real>& w, const LoopJoint& joint) {
  return joint.body.exists() ? w.bodies[joint.body].p_WB : w.closures[joint.closure].p_WF;
}

// l of the loops of one joint; 0 where all their joints are at one point.
template <class Real>
inline Real spread_of(const Mechanism& m, const Workspace<Real>& w, int group) {
  Vec3<Real> sum = zero3<Real>();
  Real count(0.0), square(0.0), extent(0.0);
  const auto for_points = [&](auto&& f) {
    for_loop_joints(m, [&](LoopJointIndex, const LoopJoint& joint) {
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
  for_loop_joints(m, [&](LoopJointIndex i, const LoopJoint& joint) {
    s.length[i] = spread_of(m, w, joint.group);
    longest = max(longest, s.length[i]);
  });
  longest = select(longest > Real(0.0), longest, Real(1.0));
  for_loop_joints(m, [&](LoopJointIndex i, const LoopJoint&) {
    s.length[i] = select(s.length[i] > Real(0.0), s.length[i], longest);
  });
  return longest;
}

// Unit wrenches of all rows, idle ones too.
template <class Real>
inline void update_loop_rows(const Mechanism& m, const Parameters<Real>& p,
                             const Workspace<Real>& w, SharedReactions<Real>& s) {
  for_loop_rows(m, [&](LoopRowIndex r, const Row& row) {
    ClosureStructure c = m.closures[row.closure];
    ClosureState<Real> x = w.closures[row.closure];
    c.needs_frames = true;
    const ClosureParameters<Real>& n = p.closures[row.closure];
    update_closure_pose(m, c, n, w.bodies, x);
    update_row(row, x, n, w.bodies[c.first], w.bodies[c.second], zero3<Real>(), s.rows[r]);
  });
}

// J without units: rows over their scale, shifts in the longest length.
template <class Real>
inline void update_loop_jacobian(const Mechanism& m, const Parameters<Real>& p,
                                 const Workspace<Real>& w, Real longest, SharedReactions<Real>& s) {
  for_loop_rows(m, [&](LoopRowIndex r, const Row& row) {
    Real& scale = s.row_scale[r];
    scale = longest;
    for_loop_joints(m, [&](LoopJointIndex i, const LoopJoint& joint) {
      if (joint.closure == row.closure) scale = s.length[i];
    });
    if (row.kind == RowKind::rotation) scale = Real(1.0);
    const Velocities<Real> j = s.jacobian.row(r);
    for (const VelocityIndex k : velocities(m)) j[k] = Real(0.0);
    add_row_rates(m, p, w, row.closure, row, s.rows[r], j);
    for (const VelocityIndex k : velocities(m)) {
      const bool slides = m.velocities[k].kind == VelocityKind::translation;
      j[k] = (slides ? longest : Real(1.0)) * j[k] / scale;
    }
  });
}

// What a row with multiplier 1 changes in the reaction of a joint.
template <class Real>
inline Wrench<Real> effect_on(const Mechanism& m, const Workspace<Real>& w, const Row& row,
                              const RowState<Real>& state, const LoopJoint& joint) {
  const ClosureStructure& c = m.closures[row.closure];
  const ClosureState<Real>& x = w.closures[row.closure];
  const Vec3<Real>& point_1 = acts_at_both_points(row.kind) ? x.p_WF : x.p_WS;
  Wrench<Real> effect{zero3<Real>(), zero3<Real>()};
  if (joint.closure.exists()) {
    if (joint.closure != row.closure) return effect;
    add_force(effect, point_1 - x.p_WF, state.force);
    effect.moment = effect.moment + state.couple;
    return effect;
  }
  const Vec3<Real>& origin = w.bodies[joint.body].p_WB;
  const bool first = carries(m, joint.body, c.first), second = carries(m, joint.body, c.second);
  if (first == second) return effect;
  if (first) {
    subtract_force(effect, point_1 - origin, state.force);
    effect.moment = effect.moment - state.couple;
  } else {
    add_force(effect, x.p_WS - origin, state.force);
    effect.moment = effect.moment + state.couple;
  }
  return effect;
}

// Effects of all rows without units, each lane for itself.
template <class Real>
inline void update_loop_effects(const Mechanism& m, const Workspace<Real>& w,
                                SharedReactions<Real>& s) {
  for_loop_rows(m, [&](LoopRowIndex r, const Row& row) {
    for_loop_joints(m, [&](LoopJointIndex i, const LoopJoint& joint) {
      s.effect(r, i) = effect_on(m, w, row, s.rows[r], joint);
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
  NullSpaceFit& fit = s.fits[static_cast<std::size_t>(i)];
  const int joints = static_cast<int>(m.loop_joints.size());
  for_loop_rows(m, [&](LoopRowIndex r, const Row&) {
    for (const VelocityIndex k : velocities(m)) {
      fit.jacobian()[r.value() * m.nv + k.value()] = lane(s.jacobian(r, k), i);
    }
    const double unit = 1.0 / lane(s.row_scale[r], i);
    for (const LoopJointIndex n : indices_of(m.loop_joints)) {
      double* effect = fit.effects() + 6 * (r.value() * joints + n.value());
      write_lane(s.effect(r, n), lane(s.length[n], i), unit, i, effect);
    }
  });
  fit.reduce(rank);
}

template <class Real>
inline void fit_lane(const Mechanism& m, int i, SharedReactions<Real>& s) {
  NullSpaceFit& fit = s.fits[static_cast<std::size_t>(i)];
  for_loop_joints(m, [&](LoopJointIndex n, const LoopJoint&) {
    write_lane(s.borne[n], lane(s.length[n], i), 1.0, i, fit.given() + 6 * n.value());
  });
  fit.fit();
  for_loop_joints(m, [&](LoopJointIndex n, const LoopJoint&) {
    read_lane(fit.change() + 6 * n.value(), lane(s.length[n], i), i, s.change[n]);
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
  for_loop_joints(m, [&](LoopJointIndex i, const LoopJoint& joint) {
    s.change[i] = {zero, zero};
    if (joint.body.exists()) {
      s.borne[i] = reactions.on_child[joint.body];
      return;
    }
    const ClosureWrench<Real> f =
        compute_closure_wrench(m.closures[joint.closure], w.closures[joint.closure]);
    s.borne[i] = {f.torque, f.force};
  });
  for (int i = 0; i < RealTraits<Real>::lanes; ++i) {
    if ((s.redundant >> i & 1u) != 0) fit_lane(m, i, s);
  }
  for_loop_joints(m, [&](LoopJointIndex i, const LoopJoint& joint) {
    if (!joint.body.exists()) return;
    Wrench<Real>& f = reactions.on_child[joint.body];
    f.force = f.force + s.change[i].force;
    f.moment = f.moment + s.change[i].moment;
  });
}

// The wrench of a closure with its share.
template <class Real>
inline void add_shared(const Mechanism& m, ClosureIndex closure, const SharedReactions<Real>& s,
                       ClosureWrench<Real>& f) {
  for_loop_joints(m, [&](LoopJointIndex i, const LoopJoint& joint) {
    if (joint.closure != closure) return;
    f.force = f.force + s.change[i].force;
    f.torque = f.torque + s.change[i].moment;
  });
}

}  // namespace linkstudy
