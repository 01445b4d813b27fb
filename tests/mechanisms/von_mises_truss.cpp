#include "tests/mechanisms/von_mises_truss.h"

#include <Eigen/Geometry>
#include <cmath>

#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/joint_at.h"

namespace linkstudy::testing {
namespace {

double length_at(const TrussData& data, double y) {
  return std::hypot(data.half_span, y);
}

}  // namespace

double truss_load(const TrussData& data, double y) {
  const double length = length_at(data, y);
  return 2.0 * data.stiffness * (length_at(data, data.rise) - length) * y / length;
}

double truss_limit_height(const TrussData& data) {
  const double a = data.half_span;
  const double length = std::cbrt(length_at(data, data.rise) * a * a);
  return std::sqrt(length * length - a * a);
}

double truss_limit_load(const TrussData& data) {
  return truss_load(data, truss_limit_height(data));
}

double truss_height(const TrussData& data, double force, bool snapped) {
  // F falls with y on both branches: between the limit and the free height, and far below.
  double low = snapped ? -10.0 * data.half_span : truss_limit_height(data);
  double high = snapped ? -data.rise : data.rise;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (truss_load(data, middle) > force ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Linkage von_mises_truss(double force, const TrussData& data) {
  Linkage linkage;
  linkage.name = "von_mises_truss";
  const double slope = std::atan2(data.rise, data.half_span);
  const double length = length_at(data, data.rise);
  for (const int side : {1, 2}) {
    const std::string n = std::to_string(side);
    for (const char* part : {"lower", "upper"}) {
      linkage.links.push_back(
          {part + n, 0.1, Eigen::Vector3d::Zero(), 1e-3 * Eigen::Matrix3d::Identity()});
    }
    Frame foot;
    foot.position = {side == 1 ? -data.half_span : data.half_span, 0, 0};
    Joint turns = joint_at("A" + n, JointType::revolute, kGround, "lower" + n, foot);
    turns.position = {side == 1 ? slope : M_PI - slope};
    // Along x of the lower part.
    Frame along;
    along.rotation = rotation_about(1, M_PI / 2);
    Joint slides = joint_at("P" + n, JointType::prismatic, "lower" + n, "upper" + n, along);
    slides.child_frame.rotation = along.rotation;
    slides.position = {length};
    slides.stiffness = {data.stiffness};
    slides.rest = {length};
    linkage.joints.push_back(turns);
    linkage.joints.push_back(slides);
  }
  Closure apex;
  apex.name = "C";
  apex.first.link = "upper1";
  apex.second.link = "upper2";
  linkage.closures = {apex};
  Load load;
  load.name = "F";
  load.type = LoadType::link_force;
  load.link = "upper1";
  load.direction = {0, -1, 0};
  load.course.shape = CourseShape::constant;
  load.course.value = force;
  linkage.loads = {load};
  return linkage;
}

}  // namespace linkstudy::testing
