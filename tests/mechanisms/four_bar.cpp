#include "tests/mechanisms/four_bar.h"

#include <cmath>

#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/joint_at.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Link slender_rod(const std::string& name, double mass, double length) {
  const double J = mass * length * length / 12.0;
  return {name, mass, Vector3d(length / 2, 0, 0), Vector3d(1e-6, J, J).asDiagonal()};
}

}  // namespace

FourBarPose four_bar_pose(double crank, double crank_rate, const FourBarGeometry& g) {
  const double bx = g.crank * std::cos(crank);
  const double by = g.crank * std::sin(crank);
  const double diagonal = std::hypot(g.ground - bx, by);
  const double towards_D = std::atan2(-by, g.ground - bx);
  const double cosine = (g.coupler * g.coupler + diagonal * diagonal - g.rocker * g.rocker) /
                        (2.0 * g.coupler * diagonal);
  const double coupler = towards_D + std::acos(cosine);
  const double rocker =
      std::atan2(by + g.coupler * std::sin(coupler), bx + g.coupler * std::cos(coupler) - g.ground);
  const double w = g.crank * crank_rate;
  return {crank,
          coupler,
          rocker,
          crank_rate,
          -w * std::sin(rocker - crank) / (g.coupler * std::sin(rocker - coupler)),
          w * std::sin(coupler - crank) / (g.rocker * std::sin(coupler - rocker))};
}

Linkage four_bar(const FourBarGeometry& g) {
  const FourBarPose pose = four_bar_pose(1.0, 5.0, g);
  Linkage linkage;
  linkage.name = "four_bar";
  linkage.gravity = Vector3d(0, -9.81, 0);
  linkage.links = {slender_rod("crank", 0.5, g.crank), slender_rod("coupler", 1.2, g.coupler),
                   slender_rod("rocker", 1.0, g.rocker)};
  linkage.joints = {
      pivot_at("A", kGround, "crank", along_x(0.0), pose.crank, pose.crank_rate),
      pivot_at("B", "crank", "coupler", along_x(g.crank), pose.coupler - pose.crank,
               pose.coupler_rate - pose.crank_rate),
      pivot_at("D", kGround, "rocker", along_x(g.ground), pose.rocker, pose.rocker_rate)};
  Closure C;
  C.name = "C";
  C.type = JointType::revolute;
  C.first = {"coupler", {x_along_z(), Vector3d(g.coupler, 0, 0)}};
  C.second = {"rocker", {x_along_z(), Vector3d(g.rocker, 0, 0)}};
  C.sde.stiffness = {1e6, 1e6, 1e6, 0, 1e4, 1e4};
  C.sde.damping = {1e3, 1e3, 1e3, 0, 10, 10};
  linkage.closures = {C};
  return linkage;
}

}  // namespace linkstudy::testing
