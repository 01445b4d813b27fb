// Everything an evaluation of the equations of motion writes. Made once per run; the step loop
// allocates nothing.
#pragma once

#include <vector>

#include "core/model/mechanism.h"
#include "core/spatial/spatial.h"

namespace linkstudy {

// Vectors in ground axes; moments about the body's own internal origin.
template <class Real>
struct BodyState {
  Mat3<Real> r;             // R_WB
  Vec3<Real> p;             // internal origin, m
  Vec3<Real> shift;         // p less the parent's p
  Vec3<Real> omega;         // angular velocity
  Vec3<Real> v;             // velocity of the origin
  Vec3<Real> alpha;         // angular acceleration for qdd = 0
  Vec3<Real> a;             // acceleration of the origin for qdd = 0, less gravity
  Inertia<Real> inertia;    // of the body and, in `composite`, of all bodies outboard
  Inertia<Real> composite;  // of bodies that carry others; else `inertia` is meant
  Wrench<Real> wrench;      // that moves the body (then: and all outboard) with qdd = 0
};

// Closure points and frames.
template <class Real>
struct ClosureState {
  Vec3<Real> p1, p2;        // points, ground, m
  Vec3<Real> arm_1, arm_2;  // from the origins of the bodies to the points
  Vec3<Real> v1, v2;        // velocities of the points
  Mat3<Real> r1, r2;        // frames, where rows need them
  // Closure force on chain 1: acting at p1 there and at p2 on chain 2, acting at p2 on both,
  // couple.
  Vec3<Real> force_points;
  Vec3<Real> force_second;
  Vec3<Real> couple;
};

// One direction of a closure. Unit wrench: `force` on the line of action and `couple`.
template <class Real>
struct RowState {
  Real d;             // displacement, m or 1
  Real rate;          // of d
  Real bias;          // second derivative of d for qdd = 0
  Real value;         // multiplier or sde force, on chain 1, N or N m
  Vec3<Real> force;   // direction of the force at the point, or zero
  Vec3<Real> couple;  // direction of the torque, or zero
};

template <class Real>
struct Workspace {
  std::vector<BodyState<Real>> bodies;  // (nb)
  std::vector<Vec3<Real>> axes;         // (nv) axis of each velocity, ground axes
  std::vector<ClosureState<Real>> closures;
  std::vector<Real> mass;                // (nv, nv) lower: mass matrix, then its factor L
  std::vector<Real> inverse_pivot;       // (nv) 1 / D
  std::vector<Real> tau;                 // (nv) generalised forces less bias
  std::vector<Real> y;                   // (nv) L^-T tau
  std::vector<Real> qdd;                 // (nv)
  std::vector<Wrench<Real>> link_loads;  // (loads) about the body's origin
  std::vector<RowState<Real>> cut_rows;  // (nc)
  std::vector<RowState<Real>> sde_rows;  // (ns)
  std::vector<Real> cut_y;               // (nc, nv) L^-T J^T, by row
  std::vector<Real> schur;               // (nc, nc) J M^-1 J^T, then its factor
  std::vector<Real> gram;                // (nc, nc) factor's Gram matrix, for redundant rows
  std::vector<Real> schur_rhs;           // (nc)
  std::vector<Real> row_inverse;         // (nc) 1 / pivot of the factor; 0: redundant row
  std::vector<Real> scratch;             // (2 nc)
  Real supplied_power = Real(0.0);       // W
  Real dissipated_power = Real(0.0);     // W
  bool redundant = false;                // some lane dropped a row in the last evaluation
};

// Ground axes are constant: their unit forces are set here and never written again.
template <class Real>
std::vector<RowState<Real>> make_rows(const std::vector<Row>& rows) {
  std::vector<RowState<Real>> states(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    states[i].force = states[i].couple = zero3<Real>();
    if (rows[i].kind != RowKind::translation_ground) continue;
    const Mat3<Real> e = identity3<Real>();
    states[i].force = rows[i].axis == 0 ? e.x : rows[i].axis == 1 ? e.y : e.z;
  }
  return states;
}

template <class Real>
Workspace<Real> make_workspace(const Mechanism& m) {
  const auto nv = static_cast<std::size_t>(m.nv);
  const auto nc = m.cut_rows.size();
  Workspace<Real> w;
  w.bodies.resize(m.bodies.size());
  w.axes.resize(nv);
  w.closures.resize(m.closures.size());
  w.mass.assign(nv * nv, Real(0.0));
  for (auto* x : {&w.inverse_pivot, &w.tau, &w.y, &w.qdd}) x->assign(nv, Real(0.0));
  w.link_loads.resize(m.loads.size());
  w.cut_rows = make_rows<Real>(m.cut_rows);
  w.sde_rows = make_rows<Real>(m.sde_rows);
  w.cut_y.assign(nc * nv, Real(0.0));
  w.schur.assign(nc * nc, Real(0.0));
  w.gram.assign(nc * nc, Real(0.0));
  w.schur_rhs.assign(nc, Real(0.0));
  w.row_inverse.assign(nc, Real(1.0));
  w.scratch.assign(2 * nc, Real(0.0));
  return w;
}

}  // namespace linkstudy
