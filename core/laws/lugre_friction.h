// LuGre friction in coefficient form (Canudas de Wit, Olsson, Astrom, Lischinsky 1995; [AugUrb18]
// eqs. (14)-(15)): surfaces touch through a bristle that bends by z,
//   z_rate = v - sigma0 |v| z / g(v),       g(v) = mu_k + (mu_s - mu_k) exp(-(v / v_s)^2)
//   mu     = sigma0 z + sigma1 z_rate + sigma2 v
// and the friction force is mu times the normal force, against the sliding speed v (m/s). In steady
// sliding mu = g(v) sgn v + sigma2 v. |z| <= mu_s / sigma0 holds for ever once it holds: there
// z_rate cannot have the sign of z. Weighted damping (Olsson 1996; Canudas de Wit and Lischinsky
// 1997): with v_d > 0 sigma1 is multiplied by exp(-(v / v_d)^2), so that a bristle not yet bent
// carries no large force at high speeds.
// In two directions z and v are vectors, and |v| takes the place of v in g, in the relaxation and
// in the weight; along one direction both forms are the same.
// The bristle relaxes at the rate sigma0 |v| / g(v), which limits the step of explicit methods.
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

template <class Real>
struct LugrePlaneState {
  std::array<Real, 2> mu, z_rate;
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

template <class Real>
inline LugrePlaneState<Real> lugre_friction(const LugreParameters<Real>& p,
                                            const std::array<Real, 2>& z,
                                            const std::array<Real, 2>& v) {
  const Real speed = sqrt(madd(v[0], v[0], v[1] * v[1]));
  const Real relaxation = p.sigma0 * speed / lugre_sliding(p, speed);
  const Real damping = lugre_damping(p, speed);
  const LugreState<Real> x = lugre_component(p, relaxation, damping, z[0], v[0]);
  const LugreState<Real> y = lugre_component(p, relaxation, damping, z[1], v[1]);
  return {{x.mu, y.mu}, {x.z_rate, y.z_rate}, relaxation};
}

}  // namespace linkstudy
