// LuGre friction in tree joints (core/laws/lugre_friction.h), driven by the joint's own reaction
// from recursive Newton-Euler. With F and M the reaction's force and its moment about the joint
// origin, e the axis, and two supports `length` apart, the normal load is
//   N = preload + |F_e / 2 + e x M / length| + |F_e / 2 - e x M / length|,   F_e = F - e (e . F),
// and |e . M| / radius more in a prismatic joint with a radius. Friction brakes the turn with
// mu N radius and the slide with mu N.
//
// The load depends on the accelerations and these on friction: both are found together by
// substitution, which converges while friction moves the load by less than its own change. Lanes
// that have settled keep their load, so that each ends as it would alone. A joint that jams (no
// balance exists) is marked in Workspace::jammed.
#pragma once

#include "core/dynamics/accelerations.h"
#include "core/dynamics/reactions.h"

namespace linkstudy {

inline constexpr int kMostSubstitutions = 60;
inline constexpr double kSettledLoad = 1e-10;  // of the load
inline constexpr double kLeastLoad = 1e-12;    // N: what counts as no load

template <class Real>
inline Real length_of(const Vec3<Real>& a) {
  return sqrt(dot(a, a));
}

template <class Real>
inline Real normal_load(const JointFrictionStructure& s, const JointFrictionParameters<Real>& n,
                        const Vec3<Real>& axis, const Wrench<Real>& reaction) {
  const Vec3<Real> half = Real(0.5) * (reaction.force - dot(axis, reaction.force) * axis);
  const Vec3<Real> couple = n.inverse_length * cross(axis, reaction.moment);
  const Real supports = length_of(half + couple) + length_of(half - couple);
  const Real load = n.preload + supports;
  return s.turn < 0 ? madd(abs(dot(axis, reaction.moment)), n.inverse_radius, load) : load;
}

// Coefficients along turn and slide, and rates of the bristles, at the present speeds.
template <class Real, class W>
inline void update_coefficients(const JointFrictionStructure& s,
                                const JointFrictionParameters<Real>& n, const Real* v,
                                JointFrictionState<Real>& x, W& w) {
  const Real turning = s.turn >= 0 ? n.radius * v[s.turn] : Real(0.0);
  const Real sliding = s.slide >= 0 ? v[s.slide] : Real(0.0);
  x.mu_turn = x.mu_slide = Real(0.0);
  if (s.turn >= 0 && s.slide >= 0) {
    const LugrePlaneState<Real> f = lugre_friction(
        n.law, std::array{at(w.z, s.z), at(w.z, s.z + 1)}, std::array{turning, sliding});
    x.mu_turn = f.mu[0];
    x.mu_slide = f.mu[1];
    at(w.z_rate, s.z) = f.z_rate[0];
    at(w.z_rate, s.z + 1) = f.z_rate[1];
    return;
  }
  const LugreState<Real> f = lugre_friction(n.law, at(w.z, s.z), s.turn >= 0 ? turning : sliding);
  (s.turn >= 0 ? x.mu_turn : x.mu_slide) = f.mu;
  at(w.z_rate, s.z) = f.z_rate;
}

// tau := tau plus the change that a new load makes to the friction of one joint.
template <class Real, class W>
inline void change_load(const JointFrictionStructure& s, const JointFrictionParameters<Real>& n,
                        Real load, JointFrictionState<Real>& x, W& w) {
  x.load = load;
  x.on_turn = x.mu_turn * load * n.radius;
  x.on_slide = x.mu_slide * load;
  if (s.turn >= 0) at(w.tau, s.turn) = at(w.friction_tau, s.turn) - x.on_turn;
  if (s.slide >= 0) at(w.tau, s.slide) = at(w.friction_tau, s.slide) - x.on_slide;
}

// One substitution; true in lanes where every load has settled.
template <class M, class Real, class Mask>
inline Mask substitute_loads(const M& m, const Parameters<Real>& p, const Mask& settled,
                             Workspace<Real, M>& w) {
  update_reactions(m, p, w, w.reactions);
  Mask now = Real(0.0) == Real(0.0);
  for_frictions(m, [&](auto i) {
    const JointFrictionStructure& s = at(m.frictions, i);
    const JointFrictionParameters<Real>& n = at(p.frictions, i);
    JointFrictionState<Real>& x = at(w.frictions, i);
    const Vec3<Real>& axis = at(w.axes, s.turn >= 0 ? s.turn : s.slide);
    const Real found = normal_load(s, n, axis, at(w.reactions.on_child, s.body));
    const Real change = abs(found - x.load);
    now = now && change <= madd(Real(kSettledLoad), found, Real(kLeastLoad));
    change_load(s, n, select(settled, x.load, found), x, w);
  });
  return settled || now;
}

// Apart, so that linkages without such joints carry none of it.
template <class M, class Real>
[[gnu::noinline]] void balance_joint_friction(const M& m, const Parameters<Real>& p, const Real* v,
                                              Workspace<Real, M>& w) {
  for_velocities(m, [&](auto k) { at(w.friction_tau, k) = at(w.tau, k); });
  for_frictions(m, [&](auto i) {
    JointFrictionState<Real>& x = at(w.frictions, i);
    update_coefficients(at(m.frictions, i), at(p.frictions, i), v, x, w);
    x.load = Real(0.0);
  });
  auto settled = Real(0.0) < Real(0.0);
  for (int pass = 0; pass < kMostSubstitutions && !all(settled); ++pass) {
    settled = substitute_loads(m, p, settled, w);
    solve_accelerations(m, p, w);
  }
  w.jammed = lane_bits(settled) ^ kAllLanes<Real>;
  for_frictions(m, [&](auto i) {
    const JointFrictionStructure& s = at(m.frictions, i);
    const JointFrictionState<Real>& x = at(w.frictions, i);
    if (s.turn >= 0) w.dissipated_power = madd(x.on_turn, v[s.turn], w.dissipated_power);
    if (s.slide >= 0) w.dissipated_power = madd(x.on_slide, v[s.slide], w.dissipated_power);
  });
}

template <class M, class Real>
inline void settle_joint_friction(const M& m, const Parameters<Real>& p, const Real* v,
                                  Workspace<Real, M>& w) {
  w.jammed = 0;
  if (friction_count(m) > 0) balance_joint_friction(m, p, v, w);
}

}  // namespace linkstudy
