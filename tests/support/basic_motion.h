// Basic motions Z1..Z6 of [Palcak] as 4x4 matrices with their constant derivative operators:
// A(q) = exp(q D), so dA/dq = D A. A screw is one basic motion too, because a turn and an advance
// along one axis commute.
// Oracle code: written from the documents only, for clarity; nothing here is shared with core/
// except the description of a linkage.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

using Matrix = Eigen::MatrixXd;
// 4x4 (and 4), with sizes known at run time only but without the heap: a fair baseline.
using Transform = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 4, 4>;
using Vector = Eigen::VectorXd;

// Turns by turn * q about a coordinate axis and advances by advance * q along it.
struct BasicMotion {
  int axis = 2;          // 0 x, 1 y, 2 z
  double turn = 0.0;     // 1 for a rotation or a screw
  double advance = 0.0;  // 1 for a translation, the pitch for a screw
};

Transform motion_matrix(const BasicMotion& motion, double q);
Transform derivative_operator(const BasicMotion& motion);

// One basic motion a coordinate, in coordinate order. Rotations as three angles z, y, x also where
// the joint asks for a quaternion.
std::vector<BasicMotion> basic_motions(const Joint& joint);

Transform transform(const Frame& frame);
Transform inverse_transform(const Transform& T);

}  // namespace linkstudy::testing
