// Everything an evaluation of the equations of motion writes. Made once per run; the step loop
// allocates nothing.
#pragma once

#include <vector>

#include "core/model/mechanism.h"
#include "core/spatial/spatial.h"

namespace linkstudy {

template <class Real>
struct BodyState {
  Mat3<Real> r;             // R_WB
  Vec3<Real> p;             // origin of the internal frame in ground, m
  Motion<Real> v;           // velocity
  Motion<Real> a;           // acceleration for qdd = 0, less gravity
  Inertia<Real> inertia;    // own
  Inertia<Real> composite;  // own and all bodies outboard
  Force<Real> external;     // loads and sdes
  Force<Real> force;        // needed to move the body and all outboard with qdd = 0
};

template <class Real>
struct RowState {
  Real d;          // displacement, m or 1
  Real rate;       // of d
  Real bias;       // second derivative of d for qdd = 0
  Real value;      // multiplier or sde force, on chain 1, N or N m
  Force<Real> w1;  // unit wrench on the first body (its opposite is -w2 on the second)
  Force<Real> w2;
};

template <class Real>
struct Workspace {
  std::vector<BodyState<Real>> bodies;   // (nb)
  std::vector<Motion<Real>> axes;        // (nv) unit motion of each velocity, ground axes about O
  std::vector<Real> mass;                // (nv, nv) lower: mass matrix, then its factor L
  std::vector<Real> inverse_pivot;       // (nv) 1 / D
  std::vector<Real> tau;                 // (nv) generalised forces less bias
  std::vector<Real> y;                   // (nv) L^-T tau
  std::vector<Real> qdd;                 // (nv)
  std::vector<RowState<Real>> cut_rows;  // (nc)
  std::vector<RowState<Real>> sde_rows;  // (ns)
  std::vector<Real> cut_y;               // (nc, nv) L^-T J^T, by row
  std::vector<Real> schur;               // (nc, nc) J M^-1 J^T, then its factor
  std::vector<Real> gram;                // (nc, nc) factor's Gram matrix, for redundant rows
  std::vector<Real> schur_rhs;           // (nc)
  std::vector<Real> kept;                // (nc) 1: row independent, 0: redundant
  std::vector<Real> scratch;             // (nc)
  Real supplied_power = Real(0.0);       // W
  Real dissipated_power = Real(0.0);     // W
  bool redundant = false;                // some lane dropped a row in the last evaluation
};

template <class Real>
Workspace<Real> make_workspace(const Mechanism& m) {
  const auto nv = static_cast<std::size_t>(m.nv);
  const auto nc = m.cut_rows.size();
  Workspace<Real> w;
  w.bodies.resize(m.bodies.size());
  w.axes.resize(nv);
  w.mass.assign(nv * nv, Real(0.0));
  for (auto* x : {&w.inverse_pivot, &w.tau, &w.y, &w.qdd}) x->assign(nv, Real(0.0));
  w.cut_rows.resize(nc);
  w.sde_rows.resize(m.sde_rows.size());
  w.cut_y.assign(nc * nv, Real(0.0));
  w.schur.assign(nc * nc, Real(0.0));
  w.gram.assign(nc * nc, Real(0.0));
  w.schur_rhs.assign(nc, Real(0.0));
  w.kept.assign(nc, Real(1.0));
  w.scratch.assign(nc, Real(0.0));
  return w;
}

}  // namespace linkstudy
