// Coordinates whose motion is a law of time. Their accelerations are known, so that bodies have
// them at qdd = 0 already (core/kinematics/joint_kinematics.h), and what is left of
//   M qdd + J^T lambda = tau,   J qdd + bias = s
// is that of the other coordinates: rows and columns of M and columns of J that belong to driven
// ones are taken out, their 1 / D is zero. The equations taken out give what a motion takes, its
// effort u along the coordinate, on the child (N or N m):
//   u = M_k qdd + J_k^T lambda - tau_k,   qdd of driven coordinates zero.
#pragma once

#include "core/model/parameters.h"
#include "core/model/walk.h"
#include "core/model/workspace.h"

namespace linkstudy {

template <class Real>
inline CoordinateMotion<Real> motion_at(const Mechanism& m, const Parameters<Real>& p,
                                        MotionIndex motion, Real t) {
  const MotionStructure& s = m.motions[motion];
  return prescribed_motion(s.law, s.rises, p.motions[motion], p.knots.data() + s.knot_begin.value(),
                           s.knot_end - s.knot_begin, t);
}

template <class Real>
inline void update_motions(const Mechanism& m, const Parameters<Real>& p, Real t,
                           Workspace<Real>& w) {
  for (const MotionIndex i : indices_of(m.motions)) w.motions[i] = motion_at(m, p, i, t);
}

// Driven coordinates of a state, q then v, as their laws have them: nothing drifts.
template <class Real>
inline void impose_motions(const Mechanism& m, const Parameters<Real>& p, Real t, Positions<Real> q,
                           Velocities<Real> v) {
  for (const MotionIndex i : indices_of(m.motions)) {
    const MotionStructure& s = m.motions[i];
    const CoordinateMotion<Real> x = motion_at(m, p, i, t);
    q[s.q] = x.q;
    v[s.v] = x.v;
  }
}

// Takes driven coordinates out of the mass matrix, lower triangle.
template <class Real>
inline void take_driven_mass(const Mechanism& m, Workspace<Real>& w) {
  for (const MotionStructure& s : m.motions) {
    for (const MotionSupportIndex i : indices(s.support_begin, s.support_end)) {
      const VelocityIndex k = m.motion_support[i];
      Real& entry = k > s.v ? w.mass(k, s.v) : w.mass(s.v, k);
      w.motion_mass[i] = entry;
      entry = Real(0.0);
    }
    w.mass(s.v, s.v) = Real(1.0);
  }
}

// After the factorisation of M.
template <class Real>
inline void fix_driven_coordinates(const Mechanism& m, Workspace<Real>& w) {
  for (const MotionStructure& s : m.motions) w.inverse_pivot[s.v] = Real(0.0);
}

// Efforts and their power, once accelerations and multipliers are there.
template <class Real>
inline void update_efforts(const Mechanism& m, Workspace<Real>& w) {
  for (const MotionIndex i : indices_of(m.motions)) {
    const MotionStructure& s = m.motions[i];
    Real effort = -w.tau[s.v];
    for (const MotionSupportIndex n : indices(s.support_begin, s.support_end)) {
      effort = madd(w.motion_mass[n], w.qdd[m.motion_support[n]], effort);
    }
    for (const RowIndex r : indices_of(m.cut_rows)) {
      effort = madd(w.motion_rows(i, r), w.cut_rows[r].value, effort);
    }
    w.efforts[i] = effort;
    w.supplied_power = madd(effort, w.motions[i].v, w.supplied_power);
  }
}

}  // namespace linkstudy
