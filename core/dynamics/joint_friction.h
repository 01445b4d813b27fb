// LuGre friction in tree joints (core/laws/lugre_friction.h), driven by the joint's own reaction
// from recursive Newton-Euler. With F and M the reaction's force and its moment about the joint
// origin, e the axis, and two supports `length` apart, the normal load is
//   N = preload + |F_e / 2 + e x M / length| + |F_e / 2 - e x M / length|,   F_e = F - e (e . F),
// and |e . M| / radius more in a prismatic joint with a radius. Friction brakes the turn with
// mu N radius and the slide with mu N.
//
// The load depends on the accelerations and these on friction. Reactions are linear in the friction
// forces, loads nearly so: both are found together by Broyden's method from zero loads, which ends
// after twice as many passes as there are such joints where loads are linear. Lanes that have
// settled keep their load, so that each ends as it would alone. Reactions shared among the joints
// of loops (core/dynamics/shared_reactions.h) are what friction feels. Where no balance exists the
// joint jams: Workspace::jammed. Where there are several (friction may then overcome what drives
// it) one of them is taken.
#pragma once

#include "core/dynamics/accelerations.h"
#include "core/dynamics/shared_reactions.h"

namespace linkstudy {

inline constexpr int kMostPasses = 60;
inline constexpr double kSettledLoad = 1e-10;   // of the load
inline constexpr double kLeastLoad = 1e-12;     // N: what counts as no load
inline constexpr double kLeastChange = 1e-280;  // N^2: too little to divide by

// A scalar that cannot see when the search is over goes a number of passes (core/codegen/traced.h).
template <class Real>
constexpr int most_passes() {
  if constexpr (requires { RealTraits<Real>::blind_passes; }) {
    return RealTraits<Real>::blind_passes;
  } else {
    return kMostPasses;
  }
}

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
  return !s.turn.exists() ? madd(abs(dot(axis, reaction.moment)), n.inverse_radius, load) : load;
}

// Coefficients along turn and slide, and rates of the bristles, at the present speeds.
template <class Real, class W>
inline void update_coefficients(const JointFrictionStructure& s,
                                const JointFrictionParameters<Real>& n, Velocities<const Real> v,
                                JointFrictionState<Real>& x, W& w) {
  const Real turning = s.turn.exists() ? n.radius * v[s.turn] : Real(0.0);
  const Real sliding = s.slide.exists() ? v[s.slide] : Real(0.0);
  x.mu_turn = x.mu_slide = Real(0.0);
  if (s.turn.exists() && s.slide.exists()) {
    const LugreVectorState<Real, 2> f =
        lugre_friction(n.law, std::array{w.z[s.z], w.z[s.z + 1]}, std::array{turning, sliding});
    x.mu_turn = f.mu[0];
    x.mu_slide = f.mu[1];
    x.relaxation = f.relaxation;
    w.z_rate[s.z] = f.z_rate[0];
    w.z_rate[s.z + 1] = f.z_rate[1];
    return;
  }
  const LugreState<Real> f = lugre_friction(n.law, w.z[s.z], s.turn.exists() ? turning : sliding);
  (s.turn.exists() ? x.mu_turn : x.mu_slide) = f.mu;
  x.relaxation = f.relaxation;
  w.z_rate[s.z] = f.z_rate;
}

// tau and the friction of one joint for a load.
template <class Real, class W>
inline void set_load(const JointFrictionStructure& s, const JointFrictionParameters<Real>& n,
                     Real load, JointFrictionState<Real>& x, W& w) {
  x.load = load;
  x.on_turn = x.mu_turn * load * n.radius;
  x.on_slide = x.mu_slide * load;
  if (s.turn.exists()) w.tau[s.turn] = w.friction_tau[s.turn] - x.on_turn;
  if (s.slide.exists()) w.tau[s.slide] = w.friction_tau[s.slide] - x.on_slide;
}

// Gaps between the loads that the reactions ask for and those in use; true in lanes where none is
// left.
template <class Real>
inline auto load_gaps(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  update_reactions(m, p, w, w.reactions);
  if (!w.shared.empty()) share_reactions(m, w, w.reactions, w.shared.front());
  auto none_left = Real(0.0) == Real(0.0);
  for (const FrictionIndex i : indices_of(m.frictions)) {
    const JointFrictionStructure& s = m.frictions[i];
    JointFrictionState<Real>& x = w.frictions[i];
    const Vec3<Real>& axis = w.axes[s.turn.exists() ? s.turn : s.slide];
    const Real found = normal_load(s, p.frictions[i], axis, w.reactions.on_child[s.body]);
    x.next_gap = found - x.load;
    none_left = none_left && abs(x.next_gap) <= madd(Real(kSettledLoad), found, Real(kLeastLoad));
  }
  return none_left;
}

// Broyden's update of H, which stands for -(d gap / d load)^-1: afterwards H takes the last change
// of the gaps to minus the last change of the loads.
template <class Real>
inline void learn_from_last_change(const Mechanism& m, Workspace<Real>& w) {
  const auto h = w.friction_inverse.view();
  Real scale(0.0);
  for (const FrictionIndex i : indices_of(m.frictions)) {
    Real sum(0.0), row(0.0);
    for (const FrictionIndex j : indices_of(m.frictions)) {
      const JointFrictionState<Real>& x = w.frictions[j];
      sum = madd(h(i, j), x.next_gap - x.gap, sum);
      row = madd(x.change, h(j, i), row);
    }
    JointFrictionState<Real>& x = w.frictions[i];
    x.missed = Real(0.0) - x.change - sum;
    x.row = row;
    scale = madd(row, x.next_gap - x.gap, scale);
  }
  const auto known = abs(scale) > Real(kLeastChange);
  const Real inverse = select(known, Real(1.0) / select(known, scale, Real(1.0)), Real(0.0));
  for (const FrictionIndex i : indices_of(m.frictions)) {
    for (const FrictionIndex j : indices_of(m.frictions)) {
      h(i, j) = madd(w.frictions[i].missed * inverse, w.frictions[j].row, h(i, j));
    }
  }
}

// Loads by H, in lanes that have not settled.
template <class Real, class Mask>
inline void change_loads(const Mechanism& m, const Parameters<Real>& p, const Mask& settled,
                         Workspace<Real>& w) {
  const auto h = w.friction_inverse.view();
  for (const FrictionIndex i : indices_of(m.frictions))
    w.frictions[i].gap = w.frictions[i].next_gap;
  for (const FrictionIndex i : indices_of(m.frictions)) {
    JointFrictionState<Real>& x = w.frictions[i];
    Real change(0.0);
    for (const FrictionIndex j : indices_of(m.frictions)) {
      change = madd(h(i, j), w.frictions[j].gap, change);
    }
    x.change = select(settled, Real(0.0), change);
    set_load(m.frictions[i], p.frictions[i], x.load + x.change, x, w);
  }
}

template <class Real>
inline void start_loads(const Mechanism& m, const Parameters<Real>& p, Velocities<const Real> v,
                        Workspace<Real>& w) {
  if (!w.shared.empty()) update_self_stresses(m, p, w, w.shared.front());
  for (const VelocityIndex k : velocities(m)) w.friction_tau[k] = w.tau[k];
  for (const FrictionIndex i : indices_of(m.frictions)) {
    JointFrictionState<Real>& x = w.frictions[i];
    update_coefficients(m.frictions[i], p.frictions[i], v, x, w);
    x.load = Real(0.0);
    for (const FrictionIndex j : indices_of(m.frictions)) {
      w.friction_inverse(i, j) = Real(i == j ? 1.0 : 0.0);
    }
  }
}

// Apart, so that linkages without such joints carry none of it.
template <class Real>
[[gnu::noinline]] void balance_joint_friction(const Mechanism& m, const Parameters<Real>& p,
                                              Velocities<const Real> v, Workspace<Real>& w) {
  start_loads(m, p, v, w);
  auto settled = load_gaps(m, p, w);
  for (int pass = 0; pass < most_passes<Real>() && !all(settled); ++pass) {
    if (pass > 0) learn_from_last_change(m, w);
    change_loads(m, p, settled, w);
    solve_accelerations(m, p, w);
    settled = load_gaps(m, p, w) || settled;
  }
  w.jammed = lane_bits(settled) ^ kAllLanes<Real>;
  for (const FrictionIndex i : indices_of(m.frictions)) {
    const JointFrictionStructure& s = m.frictions[i];
    const JointFrictionState<Real>& x = w.frictions[i];
    if (s.turn.exists()) w.dissipated_power = madd(x.on_turn, v[s.turn], w.dissipated_power);
    if (s.slide.exists()) w.dissipated_power = madd(x.on_slide, v[s.slide], w.dissipated_power);
  }
}

template <class Real>
inline void settle_joint_friction(const Mechanism& m, const Parameters<Real>& p,
                                  Velocities<const Real> v, Workspace<Real>& w) {
  w.jammed = 0;
  if (!m.frictions.empty()) balance_joint_friction(m, p, v, w);
}

}  // namespace linkstudy
