// LuGre friction in coefficient form (Canudas de Wit, Olsson, Astrom, Lischinsky 1995; [AugUrb18]
// eqs. (14)-(15)): surfaces touch through a bristle that bends by z,
//   z_rate = v - sigma0 |v| z / g(v),       g(v) = mu_k + (mu_s - mu_k) exp(-(v / v_s)^2)
//   mu     = sigma0 z + sigma1 z_rate + sigma2 v
// and the friction force is mu times the normal force, against the sliding speed v (m/s). In steady
// sliding mu = g(v) sgn v + sigma2 v. |z| <= mu_s / sigma0 holds for ever once it holds: there
// z_rate cannot have the sign of z. Weighted damping (Olsson 1996; Canudas de Wit and Lischinsky
// 1997): with v_d > 0 sigma1 is multiplied by exp(-(v / v_d)^2), so that a bristle not yet bent
// carries no large force at high speeds.
// In several directions z and v are vectors, and |v| takes the place of v in g, in the relaxation
// and in the weight; along one direction both forms are the same. The bristle relaxes at the rate
// sigma0 |v| / g(v), which limits the step of explicit methods.
#pragma once

#include <array>

#include "core/base/elementary.h"

namespace linkstudy {

template <class Real>
struct LugreParameters {
  Real mu_s;    // static coefficient
  Real mu_k;    // kinetic coefficient
  Real v_s;     // Stribeck speed, m/s, above 0
  Real sigma0;  // stiffness of the bristle, 1/m
  Real sigma1;  // damping of the bristle, s/m
  Real sigma2;  // viscous, s/m
  Real v_d;     // damping speed, m/s; 0: sigma1 does not depend on speed
};

template <class Real>
struct LugreState {
  Real mu;          // friction force / normal force, positive against positive v
  Real z_rate;      // m/s
  Real relaxation;  // sigma0 |v| / g, 1/s
};

template <class Real, std::size_t Count>
struct LugreVectorState {
  std::array<Real, Count> mu, z_rate;
  Real relaxation;
};

// exp(-(speed / width)^2)
template <class Real>
inline Real lugre_weight(Real speed, Real width) {
  const Real ratio = speed / width;
  return exp(-(ratio * ratio));
}

// g(v): coefficient of steady sliding without its viscous part.
template <class Real>
inline Real lugre_sliding(const LugreParameters<Real>& p, Real speed) {
  return madd(p.mu_s - p.mu_k, lugre_weight(speed, p.v_s), p.mu_k);
}

// sigma1 at this speed
template <class Real>
inline Real lugre_damping(const LugreParameters<Real>& p, Real speed) {
  const auto weighted = p.v_d > Real(0.0);
  const Real weight = lugre_weight(speed, select(weighted, p.v_d, Real(1.0)));
  return p.sigma1 * select(weighted, weight, Real(1.0));
}

// What the bristle does in one direction: relaxation = sigma0 |v| / g, 1/s, and damping = sigma1.
template <class Real>
inline LugreState<Real> lugre_component(const LugreParameters<Real>& p, Real relaxation,
                                        Real damping, Real z, Real v) {
  const Real z_rate = nmadd(relaxation, z, v);
  return {madd(p.sigma0, z, madd(damping, z_rate, p.sigma2 * v)), z_rate, relaxation};
}

template <class Real>
inline LugreState<Real> lugre_friction(const LugreParameters<Real>& p, Real z, Real v) {
  const Real speed = abs(v);
  const Real relaxation = p.sigma0 * speed / lugre_sliding(p, speed);
  return lugre_component(p, relaxation, lugre_damping(p, speed), z, v);
}

template <class Real, std::size_t Count>
inline Real lugre_speed(const std::array<Real, Count>& v) {
  if constexpr (Count == 1) {
    return abs(v[0]);
  } else {
    Real square = v[Count - 1] * v[Count - 1];
    for (std::size_t k = Count - 1; k-- > 0;) square = madd(v[k], v[k], square);
    return sqrt(square);
  }
}

template <class Real, std::size_t Count>
inline LugreVectorState<Real, Count> lugre_friction(const LugreParameters<Real>& p,
                                                    const std::array<Real, Count>& z,
                                                    const std::array<Real, Count>& v) {
  const Real speed = lugre_speed(v);
  LugreVectorState<Real, Count> f;
  f.relaxation = p.sigma0 * speed / lugre_sliding(p, speed);
  const Real damping = lugre_damping(p, speed);
  for (std::size_t k = 0; k < Count; ++k) {
    const LugreState<Real> x = lugre_component(p, f.relaxation, damping, z[k], v[k]);
    f.mu[k] = x.mu;
    f.z_rate[k] = x.z_rate;
  }
  return f;
}

}  // namespace linkstudy
