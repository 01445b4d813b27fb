// Euler parameters and the shortened dual quaternion of a motion b : a, to and from direction
// cosines, without loss in any orientation ([Palcak] eqs. 4.8-4.14).
//   turn by Phi about the unit vector n:  e = (w, x, y, z) = (cos Phi/2, n sin Phi/2)      (4.13)
//   S_ab, direction cosines: columns are the axes of b in a,  r_a = S_ab r_b + r_ab        (4.10)
//   motion:  E = [w, x, y, z, a1, a2, a3] with r_ab = (a1, a2, a3), origin of b in a       (4.14)
// "Shortened": r_ab itself in place of the dual part 1/2 r_ab o e of a dual quaternion, so that no
// condition joins the two halves.
// e and -e mean the same turn; returned is the one whose first part other than zero is positive.
// Positions in m; parts of e without unit. Not for the step loop.
#pragma once

#include <Eigen/Core>

namespace linkstudy {

// Of a rotation matrix, unit length. The largest of the four comes from the diagonal and is at
// least 1/2; the others come from sums and differences of pairs over it, so nothing cancels at
// half turns. An error of S reappears in e, not enlarged.
Eigen::Vector4d euler_parameters(const Eigen::Matrix3d& S);

// A rotation matrix also where e is not quite of unit length; e != 0.
Eigen::Matrix3d direction_cosines(const Eigen::Vector4d& e);

// e_ac of S_ac = S_ab S_bc: product of quaternions, of either sign.
Eigen::Vector4d compose(const Eigen::Vector4d& e_ab, const Eigen::Vector4d& e_bc);

struct ShortenedDualQuaternion {
  Eigen::Vector4d e = {1.0, 0.0, 0.0, 0.0};  // (w, x, y, z)
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
};

// T = [S, r; 0, 1] (4.8)
ShortenedDualQuaternion shortened_dual_quaternion(const Eigen::Matrix4d& T);
Eigen::Matrix4d homogeneous_matrix(const ShortenedDualQuaternion& E);

// E_ac of T_ac = T_ab T_bc (4.19), and E_ba.
ShortenedDualQuaternion compose(const ShortenedDualQuaternion& ab,
                                const ShortenedDualQuaternion& bc);
ShortenedDualQuaternion inverse(const ShortenedDualQuaternion& ab);

}  // namespace linkstudy
