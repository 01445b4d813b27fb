// Energies of a linkage after `evaluate`. Kinetic: of the bodies. Potential: gravity -m g . p_C
// (zero at the ground origin), sdes 1/2 c d^2 ([Urbas16] eq. (5)), springs in joints and between
// points (of a table the integral of its force, zero where that is least within the table), and
// K delta^(n+1) / (n+1) of contacts. Ledger:
//   kinetic + potential - (the same at the start) = supplied - dissipated + residual.
#pragma once

#include "core/forces/point_springs.h"
#include "core/model/contact_of.h"
#include "core/model/parameters.h"
#include "core/model/walk.h"
#include "core/model/workspace.h"

namespace linkstudy {

template <class Real>
struct Energy {
  Real kinetic;  // J
  Real height;   // potential energy of weight, J
  Real elastic;  // of replacement joints, springs and contacts, J

  Real potential() const { return height + elastic; }
};

template <class Real>
inline Energy<Real> compute_energy(const Mechanism& m, const Parameters<Real>& p,
                                   Positions<const Real> q, const Workspace<Real>& w) {
  Energy<Real> e{Real(0.0), Real(0.0), Real(0.0)};
  for (const BodyIndex b : bodies_outwards(m)) {
    const BodyState<Real>& s = w.bodies[b];
    const Inertia<Real>& i = s.inertia;
    // 1/2 m v.v + v.(omega x h) + 1/2 omega.I omega
    Real twice = dot(s.v_WB, madd(i.m, s.v_WB, Real(2.0) * cross(s.w_WB, i.h)));
    if (m.bodies[b].rotates) twice = twice + dot(s.w_WB, i.i * s.w_WB);
    e.kinetic = madd(Real(0.5), twice, e.kinetic);
    e.height = e.height - dot(p.gravity, madd(i.m, s.p_WB, i.h));
  }
  for (const RowIndex i : indices_of(m.sde_rows)) {
    const Real d = w.sde_rows[i].d;
    e.elastic = madd(Real(0.5) * p.springs[i].stiffness * d, d, e.elastic);
  }
  for (const JointSpringIndex i : indices_of(m.joint_springs)) {
    const JointSpringParameters<Real>& n = p.joint_springs[i];
    const Real d = q[m.joint_springs[i].q] - n.rest;
    e.elastic = madd(Real(0.5) * n.stiffness * d, d, e.elastic);
    if (m.joint_springs[i].curve.is_linear()) continue;
    e.elastic = e.elastic + curve_energy(m.joint_springs[i].curve, n.curve, p.segments,
                                         q[m.joint_springs[i].q]);
  }
  for (const PointSpringIndex i : indices_of(m.point_springs)) {
    e.elastic = e.elastic + point_spring_energy(m.point_springs[i], p.point_springs[i], p.segments,
                                                w.point_springs[i].length);
  }
  for (const ContactIndex i : indices_of(m.contacts)) {
    const ContactState<Real>& s = w.contacts[i];
    e.elastic = e.elastic + contact_energy(law_of_contact(m, p, i), s.depth, s.elastic);
  }
  return e;
}

}  // namespace linkstudy
