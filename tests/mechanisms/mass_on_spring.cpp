#include "tests/mechanisms/mass_on_spring.h"

namespace linkstudy::testing {

Linkage mass_on_spring(double mass, double stiffness, double damping) {
  Linkage linkage;
  linkage.links = {{"mass", mass, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()}};
  Joint rail;
  rail.name = "rail";
  rail.type = JointType::prismatic;
  rail.parent = kGround;
  rail.child = "mass";
  linkage.joints = {rail};
  Closure spring;
  spring.name = "spring";
  spring.model = ClosureModel::sde;
  spring.first.link = "mass";
  spring.second.link = kGround;
  spring.sde.stiffness[kZ] = stiffness;
  spring.sde.damping[kZ] = damping;
  linkage.closures = {spring};
  return linkage;
}

}  // namespace linkstudy::testing
