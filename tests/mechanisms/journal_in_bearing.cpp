#include "tests/mechanisms/journal_in_bearing.h"

#include <Eigen/Geometry>
#include <cmath>

#include "tests/mechanisms/frames.h"

namespace linkstudy::testing {

Clearance loose_bearing() {
  Clearance c;
  c.radial = 1e-3;
  c.bearing_radius = 5e-3;
  c.length = 20e-3;
  c.stiffness = 1e10;
  c.restitution = 0.9;
  return c;
}

Friction table_1_friction() {
  return {.mu_s = 0.2,
          .mu_k = 0.1,
          .v_s = 0.0175,
          .sigma0 = 600.0,
          .sigma1 = std::sqrt(600.0),
          .sigma2 = 0.0,
          .v_d = 0.0};
}

Linkage journal_in_bearing(const JournalInBearing& j, const Clearance& clearance) {
  Linkage linkage;
  linkage.links.push_back({"journal", j.mass, Eigen::Vector3d::Zero(), j.moments.asDiagonal(), {}});
  Joint joint;
  joint.name = "F";
  joint.type = JointType::free;
  joint.coordinates = RotationCoordinates::quaternion;
  joint.parent = kGround;
  joint.child = "journal";
  const double angle = j.rotation.norm();
  const Eigen::Vector3d axis =
      angle > 0.0 ? Eigen::Vector3d(j.rotation / angle) : Eigen::Vector3d::UnitZ();
  const Eigen::Quaterniond h(Eigen::AngleAxisd(angle, axis));
  joint.position = {j.position.x(), j.position.y(), j.position.z(), h.w(), h.x(), h.y(), h.z()};
  joint.velocity = {j.velocity.x(), j.velocity.y(), j.velocity.z(),
                    j.turning.x(),  j.turning.y(),  j.turning.z()};
  linkage.joints.push_back(joint);
  Closure closure;
  closure.name = "B";
  closure.type = JointType::revolute;
  closure.model = ClosureModel::clearance;
  closure.first = {"journal", {x_along_z(), Eigen::Vector3d::Zero()}};
  closure.second = {kGround, {x_along_z(), Eigen::Vector3d::Zero()}};
  closure.clearance = clearance;
  closure.clearance.kind = j.kind;
  linkage.closures.push_back(closure);
  return linkage;
}

}  // namespace linkstudy::testing
