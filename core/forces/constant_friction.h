// LuGre friction (core/laws/lugre_friction.h) in tree joints under a normal load that does not
// change, as of a preloaded bearing or a brake: with a speed u = arm * rate of each coordinate that
// rubs together, the generalised force on it is -mu(u) N arm. Rates that rub together do so as a
// vector: of a cylindrical joint the turn and the slide; of a planar one the shifts; of a ball the
// angular velocity in the child's axes, whatever its coordinates, so that a ball is braked alike
// about all axes. No reaction is asked for, and nothing can jam.
#pragma once

#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

// Angular velocity in the child's axes by a unit rate of angle k of three.
template <class Real>
inline Vec3<Real> turn_in_child(const ConstantFrictionStructure& s, int k,
                                const Workspace<Real>& w) {
  const Mat3<Real>& r = w.bodies[s.body].R_WB;
  const Vec3<Real>& axis = w.axes[s.v + k];
  return {dot(r.x, axis), dot(r.y, axis), dot(r.z, axis)};
}

// Sliding speeds, m/s; axes and bodies of w at hand.
template <std::size_t Count, class Real>
inline std::array<Real, Count> sliding_speeds(const ConstantFrictionStructure& s,
                                              const ConstantFrictionParameters<Real>& n,
                                              Velocities<const Real> v, const Workspace<Real>& w) {
  std::array<Real, Count> u;
  if constexpr (Count == 3) {
    if (s.has_angles) {
      Vec3<Real> omega = zero3<Real>();
      for (int k = 0; k < 3; ++k) omega = madd(v[s.v + k], turn_in_child(s, k, w), omega);
      return {n.arm[0] * omega.x, n.arm[1] * omega.y, n.arm[2] * omega.z};
    }
  }
  for (std::size_t k = 0; k < Count; ++k) u[k] = n.arm[k] * v[s.v + static_cast<int>(k)];
  return u;
}

// Of the forces against the speeds on the coordinates.
template <std::size_t Count, class Real>
inline void brake(const ConstantFrictionStructure& s, const std::array<Real, 3>& effort,
                  Workspace<Real>& w) {
  if constexpr (Count == 3) {
    if (s.has_angles) {
      const Vec3<Real> moment{effort[0], effort[1], effort[2]};
      for (int k = 0; k < 3; ++k) {
        w.tau[s.v + k] = w.tau[s.v + k] - dot(turn_in_child(s, k, w), moment);
      }
      return;
    }
  }
  for (std::size_t k = 0; k < Count; ++k) {
    Real& tau = w.tau[s.v + static_cast<int>(k)];
    tau = tau - effort[k];
  }
}

template <std::size_t Count, class Real>
inline void rub(const ConstantFrictionStructure& s, const ConstantFrictionParameters<Real>& n,
                Velocities<const Real> v, ConstantFrictionState<Real>& x, Workspace<Real>& w) {
  const std::array<Real, Count> u = sliding_speeds<Count>(s, n, v, w);
  std::array<Real, Count> z;
  for (std::size_t k = 0; k < Count; ++k) z[k] = w.z[s.z + static_cast<int>(k)];
  const LugreVectorState<Real, Count> f = lugre_friction(n.law, z, u);
  x.relaxation = f.relaxation;
  for (std::size_t k = 0; k < Count; ++k) {
    w.z_rate[s.z + static_cast<int>(k)] = f.z_rate[k];
    const Real force = n.load * f.mu[k];
    x.effort[k] = n.arm[k] * force;
    w.dissipated_power = madd(force, u[k], w.dissipated_power);
  }
  brake<Count>(s, x.effort, w);
}

template <class Real>
inline void add_constant_friction(const Mechanism& m, const Parameters<Real>& p,
                                  Velocities<const Real> v, Workspace<Real>& w) {
  for (const ConstantFrictionIndex i : indices_of(m.constant_frictions)) {
    const ConstantFrictionStructure& s = m.constant_frictions[i];
    const ConstantFrictionParameters<Real>& n = p.constant_frictions[i];
    ConstantFrictionState<Real>& x = w.constant_frictions[i];
    if (s.count == 1) rub<1>(s, n, v, x, w);
    if (s.count == 2) rub<2>(s, n, v, x, w);
    if (s.count == 3) rub<3>(s, n, v, x, w);
  }
}

}  // namespace linkstudy
