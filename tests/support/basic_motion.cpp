#include "tests/support/basic_motion.h"

#include <cmath>

namespace linkstudy::testing {

Transform motion_matrix(const BasicMotion& motion, double q) {
  const int j = (motion.axis + 1) % 3;
  const int k = (motion.axis + 2) % 3;
  const double c = std::cos(motion.turn * q);
  const double s = std::sin(motion.turn * q);
  Transform A = Transform::Identity(4, 4);
  A(j, j) = A(k, k) = c;
  A(k, j) = s;
  A(j, k) = -s;
  A(motion.axis, 3) = motion.advance * q;
  return A;
}

Transform derivative_operator(const BasicMotion& motion) {
  const int j = (motion.axis + 1) % 3;
  const int k = (motion.axis + 2) % 3;
  Transform D = Transform::Zero(4, 4);
  D(k, j) = motion.turn;
  D(j, k) = -motion.turn;
  D(motion.axis, 3) = motion.advance;
  return D;
}

std::vector<BasicMotion> basic_motions(const Joint& joint) {
  const BasicMotion move_x{0, 0, 1}, move_y{1, 0, 1}, move_z{2, 0, 1};
  const BasicMotion turn_x{0, 1, 0}, turn_y{1, 1, 0}, turn_z{2, 1, 0};
  switch (joint.type) {
    case JointType::revolute:
      return {turn_z};
    case JointType::prismatic:
      return {move_z};
    case JointType::cylindrical:
      return {turn_z, move_z};
    case JointType::universal:
      return {turn_z, turn_y};
    case JointType::spherical:
      return {turn_z, turn_y, turn_x};
    case JointType::planar:
      return {move_x, move_y, turn_z};
    case JointType::free:
      return {move_x, move_y, move_z, turn_z, turn_y, turn_x};
    case JointType::fixed:
    case JointType::pin_in_slot:  // of closures
    case JointType::rod:
      return {};
    case JointType::screw:
      return {BasicMotion{2, 1, joint.pitch}};
  }
  return {};
}

Transform transform(const Frame& frame) {
  Transform T = Transform::Identity(4, 4);
  T.topLeftCorner(3, 3) = frame.rotation;
  T.topRightCorner(3, 1) = frame.position;
  return T;
}

Transform inverse_transform(const Transform& T) {
  Transform inverse = Transform::Identity(4, 4);
  inverse.topLeftCorner(3, 3) = T.topLeftCorner(3, 3).transpose();
  inverse.topRightCorner(3, 1) = -T.topLeftCorner(3, 3).transpose() * T.topRightCorner(3, 1);
  return inverse;
}

}  // namespace linkstudy::testing
