#include "tests/mechanisms/cantilever.h"

#include <array>
#include <cmath>

namespace linkstudy::testing {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Link beam_link(const std::string& name, const BeamData& data, int segments,
               const BeamPlace& place) {
  const Vector3d e = place.along.normalized();
  const double rod = data.mass * data.length * data.length / 12.0;
  Link link;
  link.name = name;
  link.mass = data.mass;
  link.center_of_mass = place.begin + 0.5 * data.length * e;
  link.inertia = rod * Matrix3d::Identity() + (data.axial - rod) * e * e.transpose();
  link.flexible = FlexibleBeam{.segments = segments,
                               .begin = place.begin,
                               .end = place.begin + data.length * e,
                               .across = place.across,
                               .young = data.young,
                               .shear = data.shear,
                               .second_moment_y = data.second_moment_y,
                               .second_moment_z = data.second_moment_z,
                               .torsion_constant = data.torsion_constant,
                               .retardation = data.retardation,
                               .position = {},
                               .velocity = {}};
  return link;
}

Linkage cantilever(const BeamData& data, int segments, double wall) {
  Linkage linkage;
  linkage.name = "cantilever";
  linkage.links = {beam_link("beam", data, segments)};
  Joint joint;
  joint.name = "wall";
  joint.type = JointType::fixed;
  joint.parent = kGround;
  joint.child = "beam";
  joint.frame.position = joint.child_frame.position = Vector3d(wall, 0, 0);
  linkage.joints = {joint};
  return linkage;
}

double bending_frequency(const BeamData& data, double bending, int j) {
  // Roots of cos beta cosh beta = -1 (Blevins, Formulas for Natural Frequency and Mode Shape).
  constexpr std::array kRoots = {1.8751040687119611, 4.6940911329741746, 7.8547574382376126};
  const double beta = kRoots[static_cast<std::size_t>(j - 1)];
  return beta * beta * std::sqrt(bending / (data.mass * std::pow(data.length, 3)));
}

double torsion_frequency(const BeamData& data, int j) {
  return (2 * j - 1) * M_PI / 2.0 * std::sqrt(data.torsion() / (data.axial * data.length));
}

}  // namespace linkstudy::testing
