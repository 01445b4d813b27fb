// A closure by spring-damping elements (sde) in place of an exact joint ([Urbas16] eqs. (5), (14)):
// in every direction that the joint blocks, a row with the displacement d (m; a turn without
// dimension or in rad, core/kinematics/closure_jacobian.h) of the second end against the first and
// its rate d',
//   f = c d + b d'   on chain 1, its opposite on chain 2;   c in N/m or N m, b in N s/m or N m s.
// c d d' is stored, b d'^2 dissipated. Forces come off the wrenches of the bodies at once: an sde
// is an applied force and adds no equation, which is why it is cheap.
#pragma once

#include "core/kinematics/closure_jacobian.h"
#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

template <class Real>
inline void add_replacement_joints(const Mechanism& m, const Parameters<Real>& p,
                                   Workspace<Real>& w) {
  update_rows<RowStorage::sde>(m, p, w);
  for (const RowIndex i : indices_of(m.sde_rows)) {
    RowState<Real>& row = w.sde_rows[i];
    const SpringParameters<Real>& n = p.springs[i];
    const Real damping_force = n.damping * row.rate;
    row.value = madd(n.stiffness, row.d, damping_force);
    w.dissipated_power = madd(damping_force, row.rate, w.dissipated_power);
  }
  sum_row_forces<RowStorage::sde>(m, w);
  BodyStates<Real>& bodies = w.bodies;
  for (const ClosureIndex i : indices_of(m.closures)) {
    const ClosureStructure& c = m.closures[i];
    if (storage_of(c.model) != RowStorage::sde) continue;
    subtract_closure_forces(c, w.closures[i], bodies, bodies[c.first].wrench,
                            bodies[c.second].wrench);
  }
}

}  // namespace linkstudy
