// The equations of motion: from time, positions and velocities to accelerations, multipliers and
// sde forces. This is what the step loop calls; everything is left in the Workspace for observers.
// (q, v) has driven coordinates as their laws have them at t (impose_motions).
// Bristles of friction are read from Workspace::z, their rates are left in Workspace::z_rate.
#pragma once

#include "core/dynamics/driven_coordinates.h"
#include "core/dynamics/joint_friction.h"
#include "core/forces/applied_forces.h"
#include "core/kinematics/forward_kinematics.h"

namespace linkstudy {

// Kinematics, forces, bias, mass matrix and its factor.
template <class Real>
inline void update_factored_mass_matrix(const Mechanism& m, const Parameters<Real>& p, Real t,
                                        Positions<const Real> q, Velocities<const Real> v,
                                        Workspace<Real>& w) {
  update_motions(m, p, t, w);
  update_kinematics(m, p, q, v, w);
  update_inertial_wrenches(m, w);
  update_applied_forces(m, p, t, q, v, w);
  update_bias(m, p, w);
  update_mass_matrix(m, p, w);
  take_driven_mass(m, w);
  factorize_branch_sparse(m, w.mass.view(), Velocities<Real>(w.inverse_pivot));
  fix_driven_coordinates(m, w);
}

template <class Real>
inline void evaluate(const Mechanism& m, const Parameters<Real>& p, Real t, Positions<const Real> q,
                     Velocities<const Real> v, Workspace<Real>& w) {
  update_factored_mass_matrix(m, p, t, q, v, w);
  update_cut_joints(m, p, w);
  solve_accelerations(m, p, w);
  settle_joint_friction(m, p, v, w);
  update_efforts(m, w);
}

}  // namespace linkstudy
