#include "core/topology/flexible_beam.h"

#include <Eigen/Geometry>

#include "core/base/ensure.h"

namespace linkstudy {

Eigen::Matrix3d beam_axes(const FlexibleBeam& beam) {
  Eigen::Matrix3d axes;
  axes.col(0) = (beam.end - beam.begin).normalized();
  axes.col(2) = axes.col(0).cross(beam.across).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  ensure(axes.allFinite() && axes.col(1).squaredNorm() > 0.5,
         "the beam has a length, and its other axis is not along it");
  return axes;
}

std::string element_name(const std::string& link, int element) {
  return link + "_rfe" + std::to_string(element);
}

std::string element_joint_name(const std::string& link, int joint) {
  return link + "_sde" + std::to_string(joint);
}

}  // namespace linkstudy
