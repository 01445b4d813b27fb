#include "tests/support/trace_loads.h"

#include <algorithm>
#include <cmath>

namespace linkstudy::testing {
namespace {

double table_value(const Course& course, double t) {
  const std::vector<double>& x = course.times;
  if (x.empty()) return 0.0;
  if (t <= x.front()) return course.values.front();
  if (t >= x.back()) return course.values.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), t) - x.begin());
  const double part = (t - x[k - 1]) / (x[k] - x[k - 1]);
  return course.values[k - 1] + part * (course.values[k] - course.values[k - 1]);
}

double entry(const std::vector<double>& of_joint, std::size_t k) {
  return of_joint.empty() ? 0.0 : of_joint.at(k);
}

// Calls f with every coordinate, its joint and its number in the joint.
template <class F>
void for_coordinates(const TraceModel& model, F&& f) {
  for (const Joint& joint : model.linkage.joints) {
    const std::size_t count = basic_motions(joint).size();
    const int first = count > 0 ? coordinate_index(model, joint.name) : 0;
    for (std::size_t k = 0; k < count; ++k) f(first + static_cast<int>(k), joint, k);
  }
}

}  // namespace

double course_value(const Course& course, double t) {
  if (course.shape == CourseShape::table) return table_value(course, t);
  if (course.shape == CourseShape::constant) return course.value;
  const double s = course.duration > 0.0 ? std::clamp(t / course.duration, 0.0, 1.0) : 1.0;
  return course.value * (course.shape == CourseShape::ramp ? s : s * s * (3.0 - 2.0 * s));
}

double resistance_value(const ResistanceLaw& law, double speed) {
  const double x = speed / law.at_speed;
  return law.value * (law.shape == ResistanceShape::linear ? x : x * std::abs(x));
}

Eigen::Vector3d load_direction(const TraceLoad& load,
                               const std::vector<LinkTransform>& transforms) {
  if (!load.load.follows_link || load.link == kGroundIndex) return load.load.direction;
  return transforms[load.link].T.topLeftCorner(3, 3) * load.load.direction;
}

Vector generalised_loads(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                         double t, const Vector& v) {
  Vector Q = Vector::Zero(model.dof);
  for (const TraceLoad& load : model.loads) {
    const double value = course_value(load.load.course, t);
    switch (load.load.type) {
      case LoadType::drive:
        Q[load.coordinate] += value;
        break;
      case LoadType::resistance:
        Q[load.coordinate] -= resistance_value(load.load.law, v[load.coordinate]);
        break;
      case LoadType::link_force:
        Q += value * point_jacobian(model, transforms, load.link, load.load.point).transpose() *
             load_direction(load, transforms);
        break;
      case LoadType::link_torque:
        Q += value * rotation_jacobian(model, transforms, load.link).transpose() *
             load_direction(load, transforms);
        break;
    }
  }
  return Q;
}

Vector joint_springs(const TraceModel& model, const Vector& q, const Vector& v) {
  Vector Q = Vector::Zero(model.dof);
  for_coordinates(model, [&](int i, const Joint& joint, std::size_t k) {
    const double stretch = q[i] - entry(joint.rest, k);
    Q[i] -= entry(joint.stiffness, k) * stretch + entry(joint.damping, k) * v[i];
  });
  return Q;
}

double spring_energy(const TraceModel& model, const Vector& q) {
  double energy = 0.0;
  for_coordinates(model, [&](int i, const Joint& joint, std::size_t k) {
    const double stretch = q[i] - entry(joint.rest, k);
    energy += 0.5 * entry(joint.stiffness, k) * stretch * stretch;
  });
  return energy;
}

}  // namespace linkstudy::testing
