#include "core/model/shapes.h"

#include <cmath>
#include <limits>

namespace linkstudy {

// Exactly zero entries are what the step loop may skip: a shape follows from the numbers given.
VectorShape shape_of(const Eigen::Vector3d& a) {
  const int count = int(a.x() != 0.0) + int(a.y() != 0.0) + int(a.z() != 0.0);
  if (count == 0) return VectorShape::zero;
  if (count > 1) return VectorShape::general;
  return a.x() != 0.0   ? VectorShape::along_x
         : a.y() != 0.0 ? VectorShape::along_y
                        : VectorShape::along_z;
}

namespace {

// Entries that quarter turns leave beside 0 and 1: cos(pi / 2) rounds to 6e-17, products of a few
// turns to some ulp. A tilt by more than this is meant.
constexpr double kAxisRounding = 4.0 * std::numeric_limits<double>::epsilon();

}  // namespace

RotationShape shape_of(const Eigen::Matrix3d& r, QuarterTurn& quarter) {
  bool is_identity = true;
  for (int j = 0; j < 3; ++j) {
    int axis = 0;
    r.col(j).cwiseAbs().maxCoeff(&axis);
    const double sign = r(axis, j) > 0.0 ? 1.0 : -1.0;
    const Eigen::Vector3d off = r.col(j) - sign * Eigen::Vector3d::Unit(axis);
    if (!(off.cwiseAbs().maxCoeff() <= kAxisRounding)) return RotationShape::general;
    quarter.axis[static_cast<std::size_t>(j)] = static_cast<std::int8_t>(axis);
    quarter.sign[static_cast<std::size_t>(j)] = sign > 0.0 ? 1 : -1;
    is_identity = is_identity && axis == j && sign > 0.0;
  }
  return is_identity ? RotationShape::identity : RotationShape::quarter;
}

InertiaShape shape_of_inertia(const Eigen::Matrix3d& i) {
  const double rounding = 1e-15 * i.trace();
  const auto same = [&](double a, double b) { return std::abs(a - b) <= rounding; };
  if (!same(i(0, 1), 0.0) || !same(i(0, 2), 0.0) || !same(i(1, 2), 0.0)) {
    return InertiaShape::general;
  }
  const bool xy = same(i(0, 0), i(1, 1));
  const bool yz = same(i(1, 1), i(2, 2));
  const bool xz = same(i(0, 0), i(2, 2));
  if (xy && yz) return InertiaShape::isotropic;
  return xy   ? InertiaShape::about_z
         : yz ? InertiaShape::about_x
         : xz ? InertiaShape::about_y
              : InertiaShape::general;
}

}  // namespace linkstudy
