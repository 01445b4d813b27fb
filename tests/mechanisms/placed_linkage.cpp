#include "tests/mechanisms/placed_linkage.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using enum JointType;

// Axes with `first` as column `i` and `second`, where given, as column `i + 1`.
Matrix3d axes_of(const JointPlace& place, int i) {
  const Vector3d first = place.axis.normalized();
  const Vector3d second =
      place.second.isZero() ? first.unitOrthogonal() : Vector3d(place.second.normalized());
  Matrix3d R;
  R.col(i) = first;
  R.col((i + 1) % 3) = second;
  R.col((i + 2) % 3) = first.cross(second);
  return R;
}

}  // namespace

PlacedLinkage& PlacedLinkage::add(const std::string& name, JointType type,
                                  const std::string& parent, const std::string& child,
                                  const JointPlace& place) {
  linkage_.links.push_back({child, 1.0, place.point, 1e-2 * Matrix3d::Identity()});
  Joint joint;
  joint.name = name;
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  Matrix3d R = axes_of(place, 2);
  if (type == universal && !place.second.isZero()) {  // z, then the new y
    R.col(1) = place.second.normalized();
    R.col(0) = R.col(1).cross(R.col(2));
  }
  joint.frame = joint.child_frame = {R, place.point};
  linkage_.joints.push_back(joint);
  return *this;
}

PlacedLinkage& PlacedLinkage::close(const std::string& name, JointType type,
                                    const std::string& first, const std::string& second,
                                    const JointPlace& place) {
  Closure closure;
  closure.name = name;
  closure.type = type;
  const Frame frame{axes_of(place, 0), place.point};
  closure.first = {first, frame};
  closure.second = {second, frame};
  linkage_.closures.push_back(closure);
  return *this;
}

Linkage planar_4r() {
  return PlacedLinkage("planar_4r")
      .add("A", revolute, kGround, "crank", {{0, 0, 0}})
      .add("B", revolute, "crank", "coupler", {{0.1, 0.05, 0}})
      .add("D", revolute, kGround, "rocker", {{0.4, 0, 0}})
      .close("C", revolute, "coupler", "rocker", {{0.35, 0.3, 0}})
      .linkage();
}

Linkage five_bar() {
  return PlacedLinkage("five_bar")
      .add("A", revolute, kGround, "crank", {{0, 0, 0}})
      .add("B", revolute, "crank", "rod", {{-0.05, 0.25, 0}})
      .add("E", revolute, kGround, "other_crank", {{0.45, 0, 0}})
      .add("D", revolute, "other_crank", "other_rod", {{0.5, 0.28, 0}})
      .close("C", revolute, "rod", "other_rod", {{0.2, 0.5, 0}})
      .linkage();
}

Linkage spherical_4r() {
  const Vector3d centre(0.1, 0.2, 0.3);
  const auto axis = [&](double x, double y, double z) {
    const Vector3d e = Vector3d(x, y, z).normalized();
    return JointPlace{centre + 0.2 * e, e};
  };
  return PlacedLinkage("spherical_4r")
      .add("A", revolute, kGround, "crank", axis(0, 0, 1))
      .add("B", revolute, "crank", "coupler", axis(0.5, 0.1, 1))
      .add("D", revolute, kGround, "rocker", axis(0.2, 1, 0.7))
      .close("C", revolute, "coupler", "rocker", axis(0.9, 0.8, 0.3))
      .linkage();
}

Linkage sarrus() {
  return PlacedLinkage("sarrus")
      .add("A1", revolute, kGround, "lower1", {{1, 0, 0}, Vector3d::UnitY()})
      .add("B1", revolute, "lower1", "upper1", {{1.5, 0, 0.6}, Vector3d::UnitY()})
      .add("C1", revolute, "upper1", "platform", {{1, 0, 1.2}, Vector3d::UnitY()})
      .add("A2", revolute, kGround, "lower2", {{0, 1, 0}, Vector3d::UnitX()})
      .add("B2", revolute, "lower2", "upper2", {{0, 1.4, 0.7}, Vector3d::UnitX()})
      .close("C2", revolute, "upper2", "platform", {{0, 1, 1.2}, Vector3d::UnitX()})
      .linkage();
}

// Six edges of a cube, none in a plane with both neighbours: joints at the corners on the loop,
// each along the common normal of the axes; links 1 long, twists alternately 90 and -90 deg.
Linkage bricard() {
  // Corners of the cube around the diagonal (1, 1, 1), and the axis at each: across both edges.
  const std::array<Vector3d, 6> corner = {Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(0, 1, 0),
                                          Vector3d(0, 1, 1), Vector3d(0, 0, 1), Vector3d(1, 0, 1)};
  PlacedLinkage builder("bricard");
  const auto place = [&](std::size_t i) {
    const Vector3d before = corner[i] - corner[(i + 5) % 6];
    const Vector3d after = corner[(i + 1) % 6] - corner[i];
    return JointPlace{corner[i], before.cross(after)};
  };
  std::string parent = kGround;
  for (std::size_t i = 0; i < 5; ++i) {
    const std::string child = "link" + std::to_string(i + 1);
    builder.add("J" + std::to_string(i + 1), revolute, parent, child, place(i));
    parent = child;
  }
  return builder.close("J6", revolute, parent, kGround, place(5)).linkage();
}

Linkage rssr() {
  return PlacedLinkage("rssr")
      .add("A", revolute, kGround, "crank", {{0, 0, 0}, {0, 0, 1}})
      .add("B", spherical, "crank", "coupler", {{0.1, 0.02, 0}})
      .add("D", revolute, kGround, "rocker", {{0.4, 0.1, 0}, {1, 0.3, 0.2}})
      .close("C", spherical, "coupler", "rocker", {{0.35, 0.2, 0.25}})
      .linkage();
}

Linkage rccc() {
  return PlacedLinkage("rccc")
      .add("A", revolute, kGround, "crank", {{0, 0, 0}, {0, 0, 1}})
      .add("B", cylindrical, "crank", "coupler", {{0.1, 0.02, 0}, {0.3, 0.2, 1}})
      .add("D", cylindrical, kGround, "rocker", {{0.4, 0.1, 0}, {0.3, 1, 0.4}})
      .close("C", cylindrical, "coupler", "rocker", {{0.35, 0.2, 0.25}, {1, 0.5, -0.2}})
      .linkage();
}

Linkage triangle() {
  return PlacedLinkage("triangle")
      .add("A", revolute, kGround, "left", {{0, 0, 0}})
      .add("B", revolute, kGround, "right", {{1, 0, 0}})
      .close("C", revolute, "left", "right", {{0.4, 0.7, 0}})
      .linkage();
}

Linkage flat_parallelogram() {
  return PlacedLinkage("flat_parallelogram")
      .add("A", revolute, kGround, "crank", {{0, 0, 0}})
      .add("B", revolute, "crank", "coupler", {{0.2, 0, 0}})
      .add("D", revolute, kGround, "rocker", {{0.5, 0, 0}})
      .close("C", revolute, "coupler", "rocker", {{0.7, 0, 0}})
      .linkage();
}

Linkage stewart_platform() {
  PlacedLinkage builder("stewart_platform");
  std::array<Vector3d, 6> base, top;
  for (int i = 0; i < 6; ++i) {
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    const double b = (120.0 * (i / 2) + 15.0 * side) * M_PI / 180.0;
    const double t = (120.0 * (i / 2) + 45.0 * side) * M_PI / 180.0;
    base[static_cast<std::size_t>(i)] = Vector3d(std::cos(b), std::sin(b), 0.0);
    top[static_cast<std::size_t>(i)] = Vector3d(0.6 * std::cos(t), 0.6 * std::sin(t), 1.1);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string n = std::to_string(i + 1);
    const Vector3d leg = (top[i] - base[i]).normalized();
    const Vector3d across = leg.unitOrthogonal();
    builder.add("U" + n, universal, kGround, "lower" + n, {base[i], across, leg.cross(across)});
    builder.add("P" + n, prismatic, "lower" + n, "upper" + n, {0.5 * (base[i] + top[i]), leg});
    if (i == 0) builder.add("S1", spherical, "upper1", "platform", {top[0]});
    if (i > 0) builder.close("S" + n, spherical, "upper" + n, "platform", {top[i]});
  }
  return builder.linkage();
}

}  // namespace linkstudy::testing
