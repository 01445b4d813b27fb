// The equations of motion: from time, positions and velocities to accelerations, multipliers and
// sde forces. This is what the step loop calls; everything is left in the Workspace for observers.
#pragma once

#include "core/closures/cut_joint.h"
#include "core/dynamics/mass_matrix.h"
#include "core/forces/applied_forces.h"
#include "core/kinematics/forward_kinematics.h"

namespace linkstudy {

// Kinematics, forces, bias, mass matrix and its factor.
template <class Real>
inline void update_factored_mass_matrix(const Mechanism& m, const Parameters<Real>& p, double t,
                                        const Real* q, const Real* v, Workspace<Real>& w) {
  update_kinematics(m, p, q, v, w);
  update_inertial_wrenches(m, w);
  update_applied_forces(m, p, t, v, w);
  update_bias(m, p, w);
  update_mass_matrix(m, p, w);
  factorize_branch_sparse(m.nv, m.v_parent.data(), w.mass.data(), w.inverse_pivot.data());
}

template <class Real>
inline void evaluate(const Mechanism& m, const Parameters<Real>& p, double t, const Real* q,
                     const Real* v, Workspace<Real>& w) {
  update_factored_mass_matrix(m, p, t, q, v, w);
  const int* parent = m.v_parent.data();
  for (std::size_t k = 0; k < w.tau.size(); ++k) w.y[k] = w.tau[k];
  solve_branch_transposed(m.nv, parent, w.mass.data(), w.y.data());
  solve_cut_joints(m, p, w);
  for (std::size_t k = 0; k < w.tau.size(); ++k) w.qdd[k] = w.y[k] * w.inverse_pivot[k];
  solve_branch(m.nv, parent, w.mass.data(), w.qdd.data());
}

}  // namespace linkstudy
