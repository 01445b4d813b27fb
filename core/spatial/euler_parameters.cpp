#include "core/spatial/euler_parameters.h"

#include <Eigen/Geometry>

namespace linkstudy {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

Vector4d with_sign(const Vector4d& e) {
  for (const double part : e)
    if (part != 0.0) return part > 0.0 ? e : Vector4d(-e);
  return e;
}

// v + 2 u x (u x v + w v) / e.e for e = (w, u)
Vector3d turned(const Vector4d& e, const Vector3d& v) {
  const Vector3d u = e.tail<3>();
  return v + 2.0 / e.squaredNorm() * u.cross(u.cross(v) + e[0] * v);
}

}  // namespace

Vector4d euler_parameters(const Matrix3d& S) {
  // Symmetric: 4 e e^T, written with what S knows of each product of two parts.
  const Vector4d diagonal(1.0 + S.trace(), 1.0 + S(0, 0) - S(1, 1) - S(2, 2),
                          1.0 - S(0, 0) + S(1, 1) - S(2, 2), 1.0 - S(0, 0) - S(1, 1) + S(2, 2));
  const double wx = S(2, 1) - S(1, 2), wy = S(0, 2) - S(2, 0), wz = S(1, 0) - S(0, 1);
  const double xy = S(1, 0) + S(0, 1), xz = S(0, 2) + S(2, 0), yz = S(2, 1) + S(1, 2);
  Eigen::Matrix4d squares;
  squares << diagonal[0], wx, wy, wz,  //
      wx, diagonal[1], xy, xz,         //
      wy, xy, diagonal[2], yz,         //
      wz, xz, yz, diagonal[3];
  Eigen::Index largest = 0;
  diagonal.maxCoeff(&largest);
  return with_sign(squares.col(largest).normalized());
}

Matrix3d direction_cosines(const Vector4d& e) {
  Matrix3d S;
  for (int i = 0; i < 3; ++i) S.col(i) = turned(e, Vector3d::Unit(i));
  return S;
}

Vector4d compose(const Vector4d& a, const Vector4d& b) {
  const Vector3d u = a.tail<3>(), v = b.tail<3>();
  Vector4d product;
  product << a[0] * b[0] - u.dot(v), a[0] * v + b[0] * u + u.cross(v);
  return product;
}

ShortenedDualQuaternion shortened_dual_quaternion(const Eigen::Matrix4d& T) {
  return {euler_parameters(T.topLeftCorner<3, 3>()), T.topRightCorner<3, 1>()};
}

Eigen::Matrix4d homogeneous_matrix(const ShortenedDualQuaternion& E) {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = direction_cosines(E.e);
  T.topRightCorner<3, 1>() = E.r;
  return T;
}

ShortenedDualQuaternion compose(const ShortenedDualQuaternion& ab,
                                const ShortenedDualQuaternion& bc) {
  return {with_sign(compose(ab.e, bc.e)), ab.r + turned(ab.e, bc.r)};
}

ShortenedDualQuaternion inverse(const ShortenedDualQuaternion& ab) {
  const Vector4d back(ab.e[0], -ab.e[1], -ab.e[2], -ab.e[3]);
  return {with_sign(back), -turned(back, ab.r)};
}

}  // namespace linkstudy
