// Plain vectors and matrices as Eigen's, outside of the step loop.
#pragma once

#include <Eigen/Core>

#include "core/spatial/vector3.h"

namespace linkstudy {

inline Eigen::Vector3d to_eigen(const Vec3<double>& a) {
  return {a.x, a.y, a.z};
}

inline Eigen::Matrix3d to_eigen(const Mat3<double>& r) {
  Eigen::Matrix3d m;
  m << to_eigen(r.x), to_eigen(r.y), to_eigen(r.z);
  return m;
}

}  // namespace linkstudy
