#include "tests/mechanisms/rsup.h"

#include <cmath>

#include "core/flexible/rigid_finite_elements.h"
#include "tests/mechanisms/journal_in_bearing.h"

namespace linkstudy::testing {
namespace {

Clearance loose_pin(const Rsup& options) {
  Clearance c;
  c.kind = *options.clearance;
  c.radial = options.radial;
  c.bearing_radius = 5e-3;
  c.length = 20e-3;
  c.restitution = 0.9;
  c.approach = options.approach;
  if (options.friction) c.friction = table_1_friction();
  return c;
}

}  // namespace

FlexibleBeam steel_rod(int segments) {
  constexpr double kDiameter = 22e-3;
  const double second_moment = M_PI * std::pow(kDiameter, 4) / 64.0;
  FlexibleBeam beam;
  beam.segments = segments;
  beam.end = {0.0, RsrrpGeometry{}.coupler, 0.0};
  beam.across = Eigen::Vector3d::UnitX();
  beam.young = 207e9;
  beam.shear = 79.6e9;
  beam.second_moment_y = beam.second_moment_z = second_moment;
  beam.torsion_constant = 2.0 * second_moment;
  beam.retardation = 1e-5;
  return beam;
}

Linkage rsup(const Rsup& options) {
  Linkage linkage = rsrrp_revolute();
  linkage.name = "rsup";
  for (Load& load : linkage.loads) {
    if (load.type == LoadType::drive) load.course.duration = 2.0;
    if (load.type == LoadType::resistance) load.law.at_speed = options.at_speed;
  }
  Closure& pin = linkage.closures[0];
  pin.stabilization = Stabilization::baumgarte;
  if (options.clearance) {
    pin.model = ClosureModel::clearance;
    pin.clearance = loose_pin(options);
  }
  if (options.segments == 0) return linkage;
  for (Link& link : linkage.links) {
    if (link.name == "coupler") link.flexible = steel_rod(options.segments);
  }
  return expand_flexible_links(linkage);
}

}  // namespace linkstudy::testing
