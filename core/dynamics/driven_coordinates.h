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
inline CoordinateMotion<Real> motion_at(const Mechanism& m, const Parameters<Real>& p, int motion,
                                        Real t) {
  const MotionStructure& s = at(m.motions, motion);
  return prescribed_motion(s.law, s.rises, at(p.motions, motion), p.knots.data() + s.knot_begin,
                           s.knot_end - s.knot_begin, t);
}

template <class Real>
inline void update_motions(const Mechanism& m, const Parameters<Real>& p, Real t,
                           Workspace<Real>& w) {
  for (const int i : indices_of(m.motions)) at(w.motions, i) = motion_at(m, p, i, t);
}

// Driven coordinates of a state, q then v, as their laws have them: nothing drifts.
template <class Real>
inline void impose_motions(const Mechanism& m, const Parameters<Real>& p, Real t, Real* q,
                           Real* v) {
  for (const int i : indices_of(m.motions)) {
    const MotionStructure& s = at(m.motions, i);
    const CoordinateMotion<Real> x = motion_at(m, p, i, t);
    q[s.q] = x.q;
    v[s.v] = x.v;
  }
}

// Takes driven coordinates out of the mass matrix, lower triangle.
template <class Real>
inline void take_driven_mass(const Mechanism& m, Workspace<Real>& w) {
  for (const MotionStructure& s : m.motions) {
    for (int i = s.support_begin; i < s.support_end; ++i) {
      const int k = at(m.motion_support, i);
      Real& entry = at(w.mass, k > s.v ? k * m.nv + s.v : s.v * m.nv + k);
      at(w.motion_mass, i) = entry;
      entry = Real(0.0);
    }
    at(w.mass, s.v * m.nv + s.v) = Real(1.0);
  }
}

// After the factorisation of M.
template <class Real>
inline void fix_driven_coordinates(const Mechanism& m, Workspace<Real>& w) {
  for (const MotionStructure& s : m.motions) at(w.inverse_pivot, s.v) = Real(0.0);
}

// Efforts and their power, once accelerations and multipliers are there.
template <class Real>
inline void update_efforts(const Mechanism& m, Workspace<Real>& w) {
  const int nc = m.cut_row_count();
  for (const int i : indices_of(m.motions)) {
    const MotionStructure& s = at(m.motions, i);
    Real effort = -at(w.tau, s.v);
    for (int n = s.support_begin; n < s.support_end; ++n) {
      effort = madd(at(w.motion_mass, n), at(w.qdd, at(m.motion_support, n)), effort);
    }
    for (const int r : indices(nc)) {
      effort = madd(at(w.motion_rows, i * nc + r), at(w.cut_rows, r).value, effort);
    }
    at(w.efforts, i) = effort;
    w.supplied_power = madd(effort, at(w.motions, i).v, w.supplied_power);
  }
}

}  // namespace linkstudy
