#include "tests/mechanisms/topologies.h"

#include <cmath>

#include "core/flexible/rigid_finite_elements.h"
#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/rsup.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Link body(const std::string& name, double mass, const Vector3d& center, const Vector3d& moments) {
  return {name, mass, center, moments.asDiagonal(), {}};
}

// A tube along x, 0.8 m, 1.2 kg.
Link boom() {
  Link link = body("boom", 1.2, {0.4, 0.0, 0.0}, {3e-4, 0.064, 0.064});
  FlexibleBeam beam;
  beam.segments = 3;
  beam.end = {0.8, 0.0, 0.0};
  beam.young = 7e10;
  beam.shear = 2.6e10;
  beam.second_moment_y = beam.second_moment_z = 4e-9;
  beam.torsion_constant = 8e-9;
  beam.retardation = 2e-4;
  link.flexible = beam;
  return link;
}

JointFriction bearing_friction() {
  JointFriction f;
  f.law = {.mu_s = 0.15, .mu_k = 0.1, .v_s = 0.02, .sigma0 = 500.0, .sigma1 = 1.0};
  f.radius = 0.02;
  f.length = 0.05;
  return f;
}

Frame half_turned(const Frame& frame) {
  const Matrix3d turn = rotation_about(2, M_PI);
  return {turn * frame.rotation, turn * frame.position};
}

}  // namespace

Linkage jib() {
  Linkage linkage;
  linkage.name = "jib";
  linkage.gravity = {0.0, 0.0, -9.81};
  linkage.links = {body("column", 4.0, {0.02, 0.0, 0.2}, {0.06, 0.06, 0.01}), boom(),
                   body("carriage", 0.5, {0.0, 0.0, -0.05}, {1e-3, 1e-3, 1e-3})};
  Joint A = joint_at("A", JointType::revolute, kGround, "column", {});
  A.friction = bearing_friction();
  // Horizontal, about -y of the column, so that the boom rises with its angle.
  Joint B = joint_at("B", JointType::revolute, "column", "boom",
                     {rotation_about(0, M_PI / 2), {0.05, 0.0, 0.4}});
  B.position = {0.3};
  B.friction = bearing_friction();
  // Frame of the boom: y up. The carriage slides along x.
  Joint C = joint_at("C", JointType::prismatic, "boom", "carriage",
                     {rotation_about(1, M_PI / 2), {0.6, 0.0, 0.0}});
  C.friction = bearing_friction();
  C.stiffness = {400.0};
  linkage.joints = {A, B, C};
  Load drive;
  drive.name = "drive";
  drive.joint = "A";
  drive.course = {CourseShape::smooth, 3.0, 0.4, {}, {}};
  linkage.loads = {drive};
  return expand_flexible_links(linkage);
}

Linkage satellite() {
  Linkage linkage;
  linkage.name = "satellite";
  linkage.links = {body("hub", 5.0, {0.01, 0.0, 0.02}, {0.05, 0.06, 0.04}), boom(),
                   body("wheel", 0.8, {0.0, 2e-3, 0.0}, {1e-3, 1e-3, 2e-3})};
  Joint F = joint_at("F", JointType::free, kGround, "hub", {});
  F.velocity = {0.1, -0.2, 0.05, 0.3, 0.1, -0.2};
  Joint B =
      joint_at("B", JointType::revolute, "hub", "boom", {rotation_about(0, 0.4), {0.15, 0.0, 0.0}});
  B.stiffness = {6.0};
  B.rest = {1.0};
  B.friction = bearing_friction();
  Joint W = joint_at("W", JointType::revolute, "hub", "wheel",
                     {rotation_about(1, 0.7), {-0.1, 0.05, 0.0}});
  W.velocity = {80.0};
  W.friction = bearing_friction();
  linkage.joints = {F, B, W};
  return expand_flexible_links(linkage);
}

Linkage twin_rsup() {
  Linkage linkage = rsup({.clearance = ClearanceKind::planar, .segments = 1, .at_speed = kFast});
  linkage.name = "twin_rsup";
  linkage.gravity.setZero();
  const auto twin = [](const std::string& name) {
    return name == kGround || name == "crank" ? name : name + "2";
  };
  const Linkage one = linkage;
  for (const Link& link : one.links) {
    if (link.name == "crank") continue;
    linkage.links.push_back(link);
    linkage.links.back().name = twin(link.name);
  }
  for (const Joint& each : one.joints) {
    if (each.child == "crank") continue;
    Joint copy = each;
    copy.name = each.name + "2";
    copy.parent = twin(each.parent);
    copy.child = twin(each.child);
    if (copy.parent == each.parent) copy.frame = half_turned(each.frame);
    linkage.joints.push_back(copy);
  }
  Closure pin = one.closures[0];
  pin.name = "R2";
  pin.first.link = twin(pin.first.link);
  pin.second.link = twin(pin.second.link);
  linkage.closures.push_back(pin);
  for (Link& link : linkage.links)
    if (link.name == "crank") link.center_of_mass.setZero();
  return linkage;
}

}  // namespace linkstudy::testing
