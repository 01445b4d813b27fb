// The equations of motion: from time, positions and velocities to accelerations, multipliers and
// sde forces. This is what the step loop calls; everything is left in the Workspace for observers.
#pragma once

#include "core/closures/cut_joint.h"
#include "core/dynamics/mass_matrix.h"
#include "core/forces/applied_forces.h"
#include "core/kinematics/forward_kinematics.h"

namespace linkstudy {

// Kinematics, forces, bias, mass matrix and its factor.
template <class M, class Real>
inline void update_factored_mass_matrix(const M& m, const Parameters<Real>& p, double t,
                                        const Real* q, const Real* v, Workspace<Real, M>& w) {
  update_kinematics(m, p, q, v, w);
  update_inertial_wrenches(m, w);
  update_applied_forces(m, p, t, v, w);
  update_bias(m, p, w);
  update_mass_matrix(m, p, w);
  factorize_branch_sparse(m, w.mass.data(), w.inverse_pivot.data());
}

template <class M, class Real>
inline void evaluate(const M& m, const Parameters<Real>& p, double t, const Real* q, const Real* v,
                     Workspace<Real, M>& w) {
  update_factored_mass_matrix(m, p, t, q, v, w);
  for_velocities(m, [&](auto k) { at(w.y, k) = at(w.tau, k); });
  solve_branch_transposed(m, w.mass.data(), w.y.data());
  solve_cut_joints(m, p, w);
  for_velocities(m, [&](auto k) { at(w.qdd, k) = at(w.y, k) * at(w.inverse_pivot, k); });
  solve_branch(m, w.mass.data(), w.qdd.data());
}

}  // namespace linkstudy
