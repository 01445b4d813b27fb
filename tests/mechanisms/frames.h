// Rotations that the mechanism builders need.
#pragma once

#include <Eigen/Core>

namespace linkstudy::testing {

// Rotation by angle about coordinate axis 0, 1 or 2.
Eigen::Matrix3d rotation_about(int axis, double angle);

// psi, theta, phi with R = Rz(psi) Ry(theta) Rx(phi), |theta| <= 90 deg.
Eigen::Vector3d zyx_angles(const Eigen::Matrix3d& R);

// Axes whose x runs along z of the given axes: the axis of a joint seen as the axis of a closure.
Eigen::Matrix3d x_along_z();

}  // namespace linkstudy::testing
