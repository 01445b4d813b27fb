#include "tests/mechanisms/bushing.h"

#include <Eigen/Geometry>

namespace linkstudy::testing {

Linkage bushing(const Bushing& data) {
  Linkage linkage;
  linkage.name = "bushing";
  linkage.links = {{"body", 1.0, Eigen::Vector3d::Zero(), data.inertia.asDiagonal()}};
  Joint ball;
  ball.name = "S";
  ball.type = JointType::spherical;
  ball.coordinates = RotationCoordinates::quaternion;
  ball.parent = kGround;
  ball.child = "body";
  const double angle = data.turn.norm();
  const Eigen::Vector3d axis =
      angle > 0.0 ? Eigen::Vector3d(data.turn / angle) : Eigen::Vector3d::UnitX();
  const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, axis));
  ball.position = {q.w(), q.x(), q.y(), q.z()};
  ball.velocity = {data.rate.x(), data.rate.y(), data.rate.z()};
  linkage.joints = {ball};
  Closure element;
  element.name = "B";
  element.type = JointType::fixed;
  element.model = ClosureModel::sde;
  element.first.link = kGround;
  element.second.link = "body";
  element.sde.tilt = data.tilt;
  element.sde.start = SdeStart::given;
  for (std::size_t i = 0; i < 3; ++i) {
    element.sde.stiffness[kPhi + i] = data.stiffness[static_cast<Eigen::Index>(i)];
    element.sde.damping[kPhi + i] = data.damping[static_cast<Eigen::Index>(i)];
  }
  linkage.closures = {element};
  return linkage;
}

Linkage bushing_under(const Eigen::Vector3d& torque, const Bushing& data) {
  Linkage linkage = bushing(data);
  Load load;
  load.name = "T";
  load.type = LoadType::link_torque;
  load.link = "body";
  load.direction = torque.normalized();
  load.course.shape = CourseShape::constant;
  load.course.value = torque.norm();
  linkage.loads = {load};
  return linkage;
}

}  // namespace linkstudy::testing
