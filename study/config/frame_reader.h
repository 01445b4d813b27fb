// Poses and rotations of a validated tree.
//   axis, angle     R = E + sin(angle) [u] + (1 - cos(angle)) [u]^2 with u = axis / |axis|
//   euler_zyx       R = Rz(psi) Ry(theta) Rx(phi)
//   quaternion      w x y z, normalised when within 1e-3 of length 1
//   matrix          orthonormal to 1e-6, then made exactly so; determinant +1
#pragma once

#include <string>

#include "core/topology/linkage.h"
#include "study/config/tree.h"

namespace linkstudy {

// `owner` holds position and a rotation (frame, child_frame, first, second); `subject` names it in
// messages. What was reported reads as zero and identity.
Frame read_frame(const Tree& owner, const std::string& subject, Diagnostics& diagnostics);

Eigen::Vector3d read_vector(const Tree* value, const Eigen::Vector3d& otherwise);

// Divides by the length; `otherwise` (and a report) when that is zero.
Eigen::Vector3d read_direction(const Tree* value, const Eigen::Vector3d& otherwise,
                               const std::string& subject, Diagnostics& diagnostics);

Eigen::Matrix3d read_matrix(const Tree* value, const Eigen::Matrix3d& otherwise);

inline constexpr double kQuaternionTolerance = 1.0e-3;

}  // namespace linkstudy
