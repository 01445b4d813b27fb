#include "tests/support/zyx_equivalent.h"

#include <Eigen/Geometry>

#include "tests/mechanisms/frames.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

bool is_ball(const Joint& joint) {
  return joint.type == JointType::spherical || joint.type == JointType::free;
}

bool has_quaternion(const Joint& joint) {
  return is_ball(joint) && joint.coordinates == RotationCoordinates::quaternion;
}

Vector3d vee(const Matrix3d& S) {
  return 0.5 * Vector3d(S(2, 1) - S(1, 2), S(0, 2) - S(2, 0), S(1, 0) - S(0, 1));
}

struct Spin {
  Matrix3d R, W;  // omega = W (psi_dot, theta_dot, phi_dot)
  Vector3d omega, omega_dot;
};

Spin spin(const Vector3d& zyx, const Vector3d& rate, const Vector3d& second_rate) {
  constexpr int axes[3] = {2, 1, 0};
  const auto product = [&](int i, int j) {  // derivatives by angle i and angle j
    Matrix3d P = Matrix3d::Identity();
    for (int k = 0; k < 3; ++k) {
      const Matrix3d D = derivative_operator({axes[k], 1, 0}).topLeftCorner(3, 3);
      if (k == i) P *= D;
      if (k == j) P *= D;
      P *= rotation_about(axes[k], zyx[k]);
    }
    return P;
  };
  Spin s;
  s.R = product(-1, -1);
  Matrix3d R_ddot = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    s.W.col(i) = vee(s.R.transpose() * product(i, -1));
    R_ddot += product(i, -1) * second_rate[i];
    for (int j = 0; j < 3; ++j) R_ddot += product(i, j) * rate[i] * rate[j];
  }
  s.omega = s.W * rate;
  s.omega_dot = vee(s.R.transpose() * R_ddot);
  return s;
}

// Splits the start of a free joint in its translation and its rotation.
std::size_t rotation_start(const Joint& joint) {
  return joint.type == JointType::free ? 3 : 0;
}

Joint to_zyx(Joint joint) {
  if (!has_quaternion(joint)) return joint;
  joint.coordinates = RotationCoordinates::zyx;
  const std::size_t k = rotation_start(joint);
  if (joint.position.empty()) joint.position = {0, 0, 0, 1, 0, 0, 0};
  if (joint.position.size() == 7 && k == 0) joint.position = {1, 0, 0, 0};
  const auto& p = joint.position;
  const Matrix3d R =
      Eigen::Quaterniond(p[k], p[k + 1], p[k + 2], p[k + 3]).normalized().toRotationMatrix();
  const Vector3d zyx = zyx_angles(R);
  joint.position.resize(k);
  joint.position.insert(joint.position.end(), zyx.data(), zyx.data() + 3);
  if (joint.velocity.empty()) return joint;
  const Matrix3d W = spin(zyx, Vector3d::Zero(), Vector3d::Zero()).W;
  const Vector3d rate = W.inverse() * Eigen::Map<const Vector3d>(joint.velocity.data() + k);
  joint.velocity.resize(k);
  joint.velocity.insert(joint.velocity.end(), rate.data(), rate.data() + 3);
  return joint;
}

Joint to_quaternion(Joint joint) {
  if (!is_ball(joint) || has_quaternion(joint)) return joint;
  joint.coordinates = RotationCoordinates::quaternion;
  const std::size_t k = rotation_start(joint);
  joint.position.resize(k + 3, 0.0);
  joint.velocity.resize(k + 3, 0.0);
  const Spin s = spin(Eigen::Map<const Vector3d>(joint.position.data() + k),
                      Eigen::Map<const Vector3d>(joint.velocity.data() + k), Vector3d::Zero());
  const Eigen::Quaterniond quaternion(s.R);
  joint.position.resize(k);
  for (const double x : {quaternion.w(), quaternion.x(), quaternion.y(), quaternion.z()}) {
    joint.position.push_back(x);
  }
  for (int i = 0; i < 3; ++i) joint.velocity[k + static_cast<std::size_t>(i)] = s.omega[i];
  return joint;
}

void append(Vector& to, const Vector& part) {
  to.conservativeResize(to.size() + part.size());
  to.tail(part.size()) = part;
}

}  // namespace

Linkage with_zyx(const Linkage& linkage) {
  Linkage converted = linkage;
  for (Joint& joint : converted.joints) joint = to_zyx(joint);
  return converted;
}

Linkage with_quaternions(const Linkage& linkage) {
  Linkage converted = linkage;
  for (Joint& joint : converted.joints) joint = to_quaternion(joint);
  return converted;
}

QuaternionMotion quaternion_motion(const Linkage& linkage, const Vector& q_zyx, const Vector& v_zyx,
                                   const Vector& a_zyx) {
  QuaternionMotion motion;
  motion.v = v_zyx;
  motion.a = a_zyx;
  motion.W = Matrix::Identity(v_zyx.size(), v_zyx.size());
  int first = 0;
  for (const int j : tree_order(linkage)) {
    const Joint& joint = linkage.joints[j];
    const int count = static_cast<int>(basic_motions(joint).size());
    const int k = first + count - 3;
    if (has_quaternion(joint)) {
      const Spin s = spin(q_zyx.segment<3>(k), v_zyx.segment<3>(k), a_zyx.segment<3>(k));
      const Eigen::Quaterniond quaternion(s.R);
      append(motion.q, q_zyx.segment(first, count - 3));
      append(motion.q,
             Eigen::Vector4d(quaternion.w(), quaternion.x(), quaternion.y(), quaternion.z()));
      motion.v.segment<3>(k) = s.omega;
      motion.a.segment<3>(k) = s.omega_dot;
      motion.W.block<3, 3>(k, k) = s.W;
    } else {
      append(motion.q, q_zyx.segment(first, count));
    }
    first += count;
  }
  return motion;
}

}  // namespace linkstudy::testing
