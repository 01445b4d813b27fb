#include "tests/mechanisms/n_four_bar.h"

#include <fmt/core.h>

#include <cmath>

#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/joint_at.h"

namespace linkstudy::testing {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;

Link unit_rod(const std::string& name) {
  return {name, 1.0, Vector3d(0.5, 0, 0), Vector3d(1e-6, 1.0 / 12, 1.0 / 12).asDiagonal()};
}

Closure corner(int k) {
  Closure closure;
  closure.name = fmt::format("C{}", k);
  closure.type = JointType::revolute;
  closure.first = {fmt::format("bar{}", k), {x_along_z(), Vector3d(1, 0, 0)}};
  closure.second = {fmt::format("rod{}", k), {x_along_z(), Vector3d(1, 0, 0)}};
  closure.sde.stiffness = {1e6, 1e6, 1e6, 0, 1e5, 1e5};
  closure.sde.damping = {1e3, 1e3, 1e3, 0, 1e2, 1e2};
  return closure;
}

}  // namespace

Linkage n_four_bar(int loops) {
  Linkage linkage;
  linkage.name = fmt::format("n_four_bar_{}", loops);
  linkage.gravity = Vector3d(0, -kGravity, 0);
  for (int k = 0; k <= loops; ++k) {
    const std::string rod = fmt::format("rod{}", k);
    linkage.links.push_back(unit_rod(rod));
    linkage.joints.push_back(
        pivot_at(fmt::format("A{}", k), kGround, rod, along_x(k), M_PI / 2, -1.0));
  }
  for (int k = 1; k <= loops; ++k) {
    const std::string bar = fmt::format("bar{}", k);
    linkage.links.push_back(unit_rod(bar));
    linkage.joints.push_back(pivot_at(fmt::format("B{}", k), fmt::format("rod{}", k - 1), bar,
                                      along_x(1.0), -M_PI / 2, 1.0));
    linkage.closures.push_back(corner(k));
  }
  return linkage;
}

double n_four_bar_period(int loops) {
  const double inertia = (loops + 1) / 3.0 + loops;
  const double weight = kGravity * ((loops + 1) / 2.0 + loops);
  // The integrand is smooth and periodic: the midpoint rule converges faster than any power.
  constexpr int points = 2000;
  double time = 0.0;
  for (int k = 0; k < points; ++k) {
    const double theta = 2.0 * M_PI * (k + 0.5) / points;
    const double rate = std::sqrt(1.0 + 2.0 * weight / inertia * (1.0 - std::cos(theta)));
    time += 2.0 * M_PI / points / rate;
  }
  return time;
}

}  // namespace linkstudy::testing
