#include "tests/mechanisms/rsrrp.h"

#include <Eigen/Geometry>
#include <cmath>

#include "tests/mechanisms/frames.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d slider_axes() {
  Matrix3d R;
  R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return R;
}

Matrix3d coupler_joint_axes() {
  return rotation_about(0, -M_PI / 2);
}

Link rod(const std::string& name, double mass, double length) {
  const double transverse = mass * length * length / 12.0;
  return {name, mass, Vector3d(0, length / 2, 0),
          Vector3d(transverse, 1e-4, transverse).asDiagonal()};
}

std::vector<Link> links(const RsrrpGeometry& g) {
  return {rod("crank", 1.0, g.crank),
          {"slider", 2.0, Vector3d::Zero(), 1e-3 * Matrix3d::Identity()},
          {"yoke", 0.2, Vector3d::Zero(), 1e-4 * Matrix3d::Identity()},
          rod("coupler", 1.5, g.coupler)};
}

Joint make_joint(const std::string& name, JointType type, const std::string& parent,
                 const std::string& child, const Frame& frame, std::vector<double> position) {
  Joint joint;
  joint.name = name;
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  joint.frame = frame;
  joint.position = std::move(position);
  return joint;
}

std::vector<Load> loads() {
  Load drive;
  drive.name = "drive";
  drive.joint = "A";
  drive.course = {CourseShape::ramp, 10.0, 5.0, {}, {}};
  Load resistance;
  resistance.name = "resistance";
  resistance.type = LoadType::resistance;
  resistance.joint = "A";
  resistance.law = {ResistanceShape::linear, 10.0, 9.0};
  return {drive, resistance};
}

Linkage base(const std::string& name, const RsrrpGeometry& g) {
  Linkage linkage;
  linkage.name = name;
  linkage.gravity = Vector3d(0, -9.81, 0);
  linkage.links = links(g);
  linkage.loads = loads();
  return linkage;
}

Joint crank_joint() {
  return make_joint("A", JointType::revolute, kGround, "crank", {}, {0.0});
}

Joint slider_joint(const RsrrpGeometry& g, double d) {
  const Frame frame{slider_axes(), Vector3d(0, -g.slider_drop(), 0)};
  return make_joint("P", JointType::prismatic, kGround, "slider", frame, {d});
}

Joint yoke_joint(const RsrrpGeometry& g) {
  const Frame frame{Matrix3d::Identity(), Vector3d(g.pin, 0, 0)};
  return make_joint("Q", JointType::revolute, "slider", "yoke", frame, {0.0});
}

}  // namespace

double RsrrpGeometry::slider_drop() const {
  return coupler * std::sin(start_tilt) - crank + pin;
}

double RsrrpGeometry::pin_drop() const {
  return slider_drop() - pin;
}

RsrrpPose rsrrp_pose(double psi, const RsrrpGeometry& g) {
  const double x = g.crank * std::sin(psi);
  const double y = g.crank * std::cos(psi) + g.pin_drop();
  const double d = std::sqrt(g.coupler * g.coupler - x * x - y * y);
  return {psi, d, std::atan2(x, y), -std::acos(d / g.coupler)};
}

Linkage rsrrp() {
  const RsrrpGeometry g;
  const RsrrpPose pose = rsrrp_pose(0.0, g);
  Linkage linkage = base("rsrrp", g);
  linkage.joints = {crank_joint(), slider_joint(g, pose.d), yoke_joint(g),
                    make_joint("R", JointType::revolute, "yoke", "coupler",
                               {coupler_joint_axes(), Vector3d::Zero()}, {pose.psi23})};
  Closure S;
  S.name = "S";
  S.first = {"crank", {Matrix3d::Identity(), Vector3d(0, g.crank, 0)}};
  S.second = {"coupler", {Matrix3d::Identity(), Vector3d(0, g.coupler, 0)}};
  S.sde.stiffness = {1e6, 1e6, 1e6, 0, 0, 0};
  S.sde.damping = {1e3, 1e3, 1e3, 0, 0, 0};
  linkage.closures = {S};
  return linkage;
}

Linkage rsrrp_test_vector(ClosureModel model) {
  Linkage linkage = rsrrp();
  linkage.links[3].inertia(1, 1) = 1e-3;
  linkage.closures[0].model = model;
  return linkage;
}

Linkage rsrrp_revolute() {
  const RsrrpGeometry g;
  const RsrrpPose pose = rsrrp_pose(0.0, g);
  const Matrix3d R_yoke_coupler = coupler_joint_axes() * rotation_about(2, pose.psi23);
  const Vector3d zyx = zyx_angles(slider_axes() * R_yoke_coupler);  // crank axes = ground axes
  Linkage linkage = base("rsrrp_revolute", g);
  Joint S = make_joint("S", JointType::spherical, "crank", "coupler",
                       {Matrix3d::Identity(), Vector3d(0, g.crank, 0)}, {zyx[0], zyx[1], zyx[2]});
  S.child_frame.position = Vector3d(0, g.coupler, 0);
  linkage.joints = {crank_joint(), S, slider_joint(g, pose.d), yoke_joint(g)};
  Matrix3d second;  // columns as printed for the revolute replacement: x along -y of the yoke
  second << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  Closure R;
  R.name = "R";
  R.type = JointType::revolute;
  R.first = {"coupler", {R_yoke_coupler.transpose() * second, Vector3d::Zero()}};
  R.second = {"yoke", {second, Vector3d::Zero()}};
  R.sde.stiffness = {1e6, 1e6, 1e6, 0, 1e4, 1e4};
  R.sde.damping = {1e3, 1e3, 1e3, 0, 10, 10};
  linkage.closures = {R};
  return linkage;
}

}  // namespace linkstudy::testing
