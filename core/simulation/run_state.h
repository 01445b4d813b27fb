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
  const Bristles<const Real> z(y + m.nq + m.nv);
  for (const BristleIndex i : indices_of(w.z)) w.z[i] = z[i];
  evaluate(m, p, t, y, y + m.nq, w);
}

// dy/dt, from the evaluation at y.
template <class Real>
inline void write_slopes(const Mechanism& m, const Real* y, const Workspace<Real>& w, Real* slope) {
  const Positions<const Real> q(y);
  const Velocities<const Real> v(y + m.nq);
  const Positions<Real> q_rate(slope);
  const Velocities<Real> v_rate(slope + m.nq);
  for (const Stage& s : m.stages) position_rates(s, &q[s.q], &v[s.v], &q_rate[s.q]);
  for (const VelocityIndex k : velocities(m)) v_rate[k] = w.qdd[k];
  for (const MotionIndex i : indices_of(m.motions)) v_rate[m.motions[i].v] = w.motions[i].a;
  Real* rest = slope + m.nq + m.nv;
  for (const BristleIndex i : indices_of(w.z_rate)) rest[i.value()] = w.z_rate[i];
  rest[m.nz] = w.supplied_power;
  rest[m.nz + 1] = w.dissipated_power;
  if (m.contact_count() > 0) rest[m.nz + 2] = w.contact_power;
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
