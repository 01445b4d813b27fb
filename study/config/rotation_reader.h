// Rotations and directions of a validated tree.
//   axis, angle     R = E + sin(angle) [u] + (1 - cos(angle)) [u]^2 with u = axis / |axis|
//   euler_zyx       R = Rz(psi) Ry(theta) Rx(phi)
//   quaternion      w x y z, normalised when within 1e-3 of length 1
//   matrix          orthonormal to 1e-6, then made exactly so; determinant +1
#pragma once

#include "core/topology/linkage.h"
#include "study/config/key.h"

namespace linkstudy {

// `owner` holds the rotation of a frame (frame, child_frame, first, second), in a table of its own
// or beside the position. What was reported reads as identity.
void read_rotation(Frame& frame, Tree& owner, const Reading& reading);

Eigen::Vector3d read_vector(const Tree* value, const Eigen::Vector3d& otherwise);

// Divides by the length; a report when that is zero.
void normalise_direction(Eigen::Vector3d& direction, Tree& value, const Reading& reading);

inline constexpr double kQuaternionTolerance = 1.0e-3;

}  // namespace linkstudy
