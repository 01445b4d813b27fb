#include "tests/mechanisms/pendulum.h"

#include <cmath>

namespace linkstudy::testing {

Linkage pendulum(double mass, double length) {
  Linkage linkage;
  linkage.name = "pendulum";
  linkage.gravity = Eigen::Vector3d(0, -9.81, 0);
  linkage.links = {{"rod", mass, Eigen::Vector3d(length, 0, 0), Eigen::Matrix3d::Zero()}};
  Joint joint;
  joint.name = "A";
  joint.parent = kGround;
  joint.child = "rod";
  linkage.joints = {joint};
  return linkage;
}

double pendulum_period(double length, double gravity, double amplitude) {
  return 4.0 * std::sqrt(length / gravity) * std::comp_ellint_1(std::sin(amplitude / 2.0));
}

}  // namespace linkstudy::testing
