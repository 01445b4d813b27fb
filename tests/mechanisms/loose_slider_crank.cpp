#include "tests/mechanisms/loose_slider_crank.h"

#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/journal_in_bearing.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kCrank = 0.05, kRod = 0.12;  // m

Link bar(const std::string& name, double mass, double length, double inertia) {
  return {
      name, mass, Vector3d(length / 2, 0, 0), Vector3d(1e-5, inertia, inertia).asDiagonal(), {}};
}

Closure pin(ClearanceKind kind) {
  Closure R;
  R.name = "R";
  R.type = JointType::revolute;
  R.model = ClosureModel::clearance;
  R.first = {"rod", {x_along_z(), Vector3d(kRod, 0, 0)}};
  R.second = {"slider", {x_along_z(), Vector3d::Zero()}};
  R.clearance = loose_bearing();
  R.clearance.kind = kind;
  R.clearance.radial = 5e-4;
  R.clearance.friction = table_1_friction();
  return R;
}

}  // namespace

Linkage loose_slider_crank(ClearanceKind kind, double crank_speed) {
  Linkage linkage;
  linkage.name = "loose_slider_crank";
  linkage.gravity = {0.0, -9.81, 0.0};
  linkage.links = {bar("crank", 0.3, kCrank, 1e-4),
                   bar("rod", 0.21, kRod, 2.5e-4),
                   {"slider", 0.14, Vector3d::Zero(), 1e-4 * Matrix3d::Identity(), {}}};
  Joint A = joint_at("A", JointType::cylindrical, kGround, "crank", {});
  A.velocity = {crank_speed, 0.0};
  Joint B = joint_at("B", JointType::spherical, "crank", "rod",
                     {Matrix3d::Identity(), Vector3d(kCrank, 0, 0)});
  B.velocity = {-crank_speed * (1.0 + kCrank / kRod), 0.0, 0.0};
  Joint P = joint_at("P", JointType::prismatic, kGround, "slider",
                     {rotation_about(1, M_PI / 2), Vector3d(kCrank + kRod, 0, 0)});
  // Axes of the slider are those of the ground.
  P.child_frame.rotation = rotation_about(1, M_PI / 2);
  linkage.joints = {A, B, P};
  linkage.closures = {pin(kind)};
  return linkage;
}

}  // namespace linkstudy::testing
