#include "tests/mechanisms/spatial_slider_crank.h"

#include <cmath>

#include "tests/mechanisms/frames.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Local z along the ground's x: a joint about or along the ground's x axis.
Matrix3d z_along_x() {
  return x_along_z().transpose();
}

Joint make_joint(const std::string& name, JointType type, const std::string& parent,
                 const std::string& child) {
  Joint joint;
  joint.name = name;
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  return joint;
}

// The crank frame is the ground's at psi = 0: crank along its local z, axis along its local x.
Joint crank_joint(const SpatialSliderCrankGeometry& g, double rate) {
  Joint A = make_joint("A", JointType::revolute, kGround, "crank");
  A.frame = {z_along_x(), Vector3d(0, g.pivot_y, g.pivot_z)};
  A.child_frame.rotation = z_along_x();
  A.position = {0.0};
  A.velocity = {rate};
  return A;
}

Joint slider_joint(const SpatialSliderCrankPose& pose) {
  Joint P = make_joint("P", JointType::prismatic, kGround, "slider");
  P.frame.rotation = z_along_x();
  P.child_frame.rotation = z_along_x();
  P.position = {pose.x};
  P.velocity = {pose.x_rate};
  return P;
}

Linkage base(const std::string& name) {
  const SpatialSliderCrankGeometry g;
  Linkage linkage;
  linkage.name = name;
  linkage.gravity = Vector3d(0, 0, -9.81);
  linkage.links = {
      {"crank", 0.12, Vector3d(0, 0, g.crank / 2), Vector3d(1e-4, 1e-4, 1e-5).asDiagonal()},
      {"rod", 0.5, Vector3d(g.rod / 2, 0, 0), Vector3d(4e-4, 4e-3, 4e-3).asDiagonal()},
      {"slider", 2.0, Vector3d::Zero(), 1e-4 * Matrix3d::Identity()}};
  return linkage;
}

Matrix3d rod_axes(const SpatialSliderCrankPose& pose) {
  return z_along_x() * rotation_about(2, pose.first) * rotation_about(1, pose.second);
}

// Angular velocity of the rod in ground axes: about the ground's x, then about the turned y.
Vector3d rod_spin(const SpatialSliderCrankPose& pose) {
  return pose.first_rate * Vector3d::UnitX() + pose.second_rate * rod_axes(pose).col(1);
}

}  // namespace

SpatialSliderCrankPose spatial_slider_crank_pose(double psi, double rate,
                                                 const SpatialSliderCrankGeometry& g) {
  const double y = g.pivot_y - g.crank * std::sin(psi);
  const double z = g.pivot_z + g.crank * std::cos(psi);
  const double y_rate = -g.crank * std::cos(psi) * rate;
  const double z_rate = -g.crank * std::sin(psi) * rate;
  const double x = std::sqrt(g.rod * g.rod - y * y - z * z);
  const double x_rate = -(y * y_rate + z * z_rate) / x;
  return {psi,
          x,
          std::atan2(z, y),
          std::asin(x / g.rod),
          rate,
          x_rate,
          (y * z_rate - z * y_rate) / (y * y + z * z),
          x_rate / std::sqrt(g.rod * g.rod - x * x)};
}

Linkage spatial_slider_crank() {
  const SpatialSliderCrankGeometry g;
  const SpatialSliderCrankPose pose = spatial_slider_crank_pose(0.0, 6.0, g);
  Linkage linkage = base("spatial_slider_crank");
  Joint U = make_joint("U", JointType::universal, "slider", "rod");
  U.frame.rotation = z_along_x();
  U.position = {pose.first, pose.second};
  U.velocity = {pose.first_rate, pose.second_rate};
  linkage.joints = {crank_joint(g, 6.0), slider_joint(pose), U};
  Closure S;
  S.name = "S";
  S.first = {"crank", {Matrix3d::Identity(), Vector3d(0, 0, g.crank)}};
  S.second = {"rod", {Matrix3d::Identity(), Vector3d(g.rod, 0, 0)}};
  S.sde.stiffness = {1e6, 1e6, 1e6, 0, 0, 0};
  S.sde.damping = {1e3, 1e3, 1e3, 0, 0, 0};
  linkage.closures = {S};
  return linkage;
}

Linkage spatial_slider_crank_cut_at_universal() {
  const SpatialSliderCrankGeometry g;
  const SpatialSliderCrankPose pose = spatial_slider_crank_pose(0.0, 6.0, g);
  const Matrix3d R = rod_axes(pose);  // in crank axes too, which are the ground's at the start
  Linkage linkage = base("spatial_slider_crank_cut_at_universal");
  Joint S = make_joint("S", JointType::spherical, "crank", "rod");
  S.frame.position = Vector3d(0, 0, g.crank);
  S.child_frame.rotation = R.transpose();  // so that psi = theta = phi = 0
  S.child_frame.position = Vector3d(g.rod, 0, 0);
  S.position = {0.0, 0.0, 0.0};
  const Vector3d relative = rod_spin(pose) - Vector3d(6.0, 0, 0);
  S.velocity = {relative.z(), relative.y(), relative.x()};
  linkage.joints = {crank_joint(g, 6.0), S, slider_joint(pose)};
  Closure U;
  U.name = "U";
  U.type = JointType::universal;
  U.first = {"slider", {}};
  U.second = {"rod", {}};
  U.sde.stiffness = {1e6, 1e6, 1e6, 0, 0, 1e4};
  U.sde.damping = {1e3, 1e3, 1e3, 0, 0, 10};
  linkage.closures = {U};
  return linkage;
}

}  // namespace linkstudy::testing
