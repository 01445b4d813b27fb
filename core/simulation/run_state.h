// The state of a run as one row of numbers,
//   y = q (nq), v (nv), z (nz), supplied, dissipated, and of linkages with contacts what of it is
//       dissipated there
// with its slopes, and its return to unit quaternions, closed joints and the laws of driven
// coordinates after a step. This is what
// runs of constant steps (run.h) and of adaptive ones (located_run.h) share of the motion.
#pragma once

#include "core/closures/projection.h"
#include "core/dynamics/equations_of_motion.h"

namespace linkstudy {

// Works, J: nothing depends on them.
[[gnu::always_inline]] inline int work_count(const Mechanism& m) {
  return m.contact_count() > 0 ? 3 : 2;
}

[[gnu::always_inline]] inline int first_work(const Mechanism& m) {
  return m.nq + m.nv + m.nz;
}

[[gnu::always_inline]] inline int state_size(const Mechanism& m) {
  return first_work(m) + work_count(m);
}

// The equations of motion at (t, y).
template <class Real>
inline void evaluate_state(const Mechanism& m, const Parameters<Real>& p, Real t, const Real* y,
                           Workspace<Real>& w) {
  const Real* v = y + m.nq;
  for (const int i : indices(m.nz)) at(w.z, i) = v[m.nv + i];
  evaluate(m, p, t, y, v, w);
}

// dy/dt, from the evaluation at y.
template <class Real>
inline void write_slopes(const Mechanism& m, const Real* y, const Workspace<Real>& w, Real* slope) {
  for (const int i : indices_of(m.stages)) {
    const Stage& s = at(m.stages, i);
    position_rates(s, y + s.q, y + m.nq + s.v, slope + s.q);
  }
  Real* rest = slope + m.nq;
  for (const int k : velocities(m)) rest[k] = at(w.qdd, k);
  for (const int i : indices_of(m.motions)) rest[at(m.motions, i).v] = at(w.motions, i).a;
  for (const int i : indices(m.nz)) rest[m.nv + i] = at(w.z_rate, i);
  rest[m.nv + m.nz] = w.supplied_power;
  rest[m.nv + m.nz + 1] = w.dissipated_power;
  if (m.contact_count() > 0) rest[m.nv + m.nz + 2] = w.contact_power;
}

// The state at t. Leaves in w what the projection has found; correction (nv) is scratch.
template <class Real>
inline void settle_state(const Mechanism& m, const Parameters<Real>& p, Real t, Real* y,
                         Real* correction, Workspace<Real>& w) {
  impose_motions(m, p, t, y, y + m.nq);
  if (!m.ball_q.empty()) normalize_quaternions(m, y);
  if (!m.projects) return;
  update_factored_mass_matrix(m, p, t, y, y + m.nq, w);
  project(m, p, y, y + m.nq, correction, w);
}

}  // namespace linkstudy
