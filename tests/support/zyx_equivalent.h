// The same motion in quaternion coordinates. The oracle knows rotations as angles psi, theta, phi
// only, where v = dq/dt; a joint with a quaternion has v = omega, the angular velocity of the child
// in its own joint axes. From R = Rz(psi) Ry(theta) Rx(phi):
//   omega^ = R^T R_dot,   omega_dot^ = skew part of R^T R_ddot
#pragma once

#include "tests/support/trace_model.h"

namespace linkstudy::testing {

// All spherical and free joints with the other coordinates; their starts are converted too.
Linkage with_zyx(const Linkage& linkage);
Linkage with_quaternions(const Linkage& linkage);

struct QuaternionMotion {
  Vector q;     // (nq) as the linkage's own coordinates say
  Vector v, a;  // (nv)
  Matrix W;     // v = W v_zyx, (nv x nv); mass matrices: M_zyx = W^T M W
};

// q, v, a in zyx angles to the coordinates of `linkage` (its quaternion joints only).
QuaternionMotion quaternion_motion(const Linkage& linkage, const Vector& q_zyx, const Vector& v_zyx,
                                   const Vector& a_zyx);

}  // namespace linkstudy::testing
