// Energies of a linkage after `evaluate`. Kinetic: of the bodies. Potential: gravity -m g . p_C
// (zero at the ground origin) and sdes 1/2 c d^2 ([Urbas16] eq. (5)). Ledger:
//   kinetic + potential - (the same at the start) = supplied - dissipated + residual.
#pragma once

#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

template <class Real>
struct Energy {
  Real kinetic;    // J
  Real potential;  // J
};

template <class Real>
inline Energy<Real> compute_energy(const Mechanism& m, const Parameters<Real>& p,
                                   const Workspace<Real>& w) {
  Energy<Real> e{Real(0.0), Real(0.0)};
  for (std::size_t b = 1; b < w.bodies.size(); ++b) {
    const BodyState<Real>& s = w.bodies[b];
    const Inertia<Real>& i = s.inertia;
    // 1/2 m v.v + v.(omega x h) + 1/2 omega.I omega
    Real twice = dot(s.v, madd(i.m, s.v, Real(2.0) * cross(s.omega, i.h)));
    if (m.bodies[b].rotates) twice = twice + dot(s.omega, i.i * s.omega);
    e.kinetic = madd(Real(0.5), twice, e.kinetic);
    e.potential = e.potential - dot(p.gravity, madd(i.m, s.p, i.h));
  }
  for (std::size_t i = 0; i < w.sde_rows.size(); ++i) {
    const Real d = w.sde_rows[i].d;
    e.potential = madd(Real(0.5) * p.springs[i].stiffness * d, d, e.potential);
  }
  return e;
}

}  // namespace linkstudy
