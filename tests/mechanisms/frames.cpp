#include "tests/mechanisms/frames.h"

#include <Eigen/Geometry>
#include <cmath>

namespace linkstudy::testing {

Eigen::Matrix3d rotation_about(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

Eigen::Vector3d zyx_angles(const Eigen::Matrix3d& R) {
  return {std::atan2(R(1, 0), R(0, 0)), std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0))),
          std::atan2(R(2, 1), R(2, 2))};
}

Eigen::Matrix3d x_along_z() {
  Eigen::Matrix3d R;
  R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return R;
}

}  // namespace linkstudy::testing
