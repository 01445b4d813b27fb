#include "core/dynamics/differences.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/dynamics/motion.h"
#include "core/model/walk.h"
#include "core/spatial/to_eigen.h"

namespace linkstudy {
namespace {

constexpr double kStep = 1e-3;         // rad, or of the length
constexpr double kCoincidence = 1e-6;  // m

}  // namespace

Extent compute_extent(const Model& model, const State<double>& s) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  compute_motion(m, model.parameters, s, w);
  Eigen::AlignedBox3d box;
  Extent extent;
  const auto add = [&](const Vec3<double>& point) {
    box.extend(to_eigen(point));
    extent.farthest = std::max(extent.farthest, to_eigen(point).norm());
  };
  for (const BodyIndex b : bodies_outwards(m)) {
    const BodyParameters<double>& n = model.parameters.bodies[b];
    add(w.bodies[b].p_WB);
    add(w.bodies[b].p_WB + w.bodies[b].R_WB * ((1.0 / n.mass) * n.moment));
  }
  for (const ClosureState<double>& c : w.closures) {
    add(c.p_WF);
    add(c.p_WS);
  }
  for (const PointSpringIndex i : indices_of(w.point_springs)) {
    const PointSpringStructure& spring = m.point_springs[i];
    add(w.bodies[spring.first].p_WB + w.point_springs[i].arm_1);
    add(w.bodies[spring.second].p_WB + w.point_springs[i].arm_2);
  }
  const double length = box.isEmpty() ? 0.0 : box.diagonal().norm();
  if (length > kCoincidence) extent.length = length;
  return extent;
}

Eigen::VectorXd difference_steps(const Model& model, const State<double>& s) {
  const Mechanism& m = model.mechanism;
  const double length = compute_extent(model, s).length;
  Eigen::VectorXd steps(m.nv);
  for (const VelocityIndex k : velocities(m)) {
    const Velocity& velocity = m.velocities[k];
    const double advance = std::abs(model.parameters.pitch[velocity.stage]);
    double& step = steps[k.value()];
    step = kStep;
    if (velocity.kind == VelocityKind::translation) step *= length;
    if (velocity.kind == VelocityKind::screw) step *= std::min(1.0, length / advance);
  }
  return steps;
}

}  // namespace linkstudy
