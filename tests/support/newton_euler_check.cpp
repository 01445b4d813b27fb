#include "tests/support/newton_euler_check.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "tests/mechanisms/frames.h"
#include "tests/support/trace_loads.h"
#include "tests/support/trace_model.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Unit wrench of one coordinate on the child at the joint's origin.
struct Direction3 {
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
};

// Axes of the three angles, q = psi, theta, phi, in the axes R of the joint.
void add_angles(const Matrix3d& R, const double* q, std::vector<Direction3>& axes) {
  const Matrix3d turned = R * rotation_about(2, q[0]);
  axes.push_back({.torque = R.col(2)});
  axes.push_back({.torque = turned.col(1)});
  axes.push_back({.torque = (turned * rotation_about(1, q[1])).col(0)});
}

std::vector<Direction3> coordinate_axes(JointType type, const Matrix3d& R, const double* q) {
  std::vector<Direction3> axes;
  const bool turns = type == JointType::revolute || type == JointType::cylindrical;
  const bool slides = type == JointType::prismatic || type == JointType::cylindrical;
  if (turns) axes.push_back({.torque = R.col(2)});
  if (slides) axes.push_back({.force = R.col(2)});
  if (type == JointType::free) {
    for (int k = 0; k < 3; ++k) axes.push_back({.force = R.col(k)});
  }
  if (type == JointType::spherical) add_angles(R, q, axes);
  if (type == JointType::free) add_angles(R, q + 3, axes);
  if (axes.empty() && type != JointType::fixed) throw std::invalid_argument("joint type");
  return axes;
}

double entry(const std::vector<double>& values, int k) {
  return values.empty() ? 0.0 : values[static_cast<std::size_t>(k)];
}

// N = preload + |F / 2 + e x M / l| + |F / 2 - e x M / l|, F and M across the axis e; in a
// prismatic joint |M . e| / r more.
double normal_load(const Joint& joint, const JointReaction& reaction, const Vector3d& e) {
  const JointFriction& f = *joint.friction;
  const Vector3d across = reaction.force - reaction.force.dot(e) * e;
  const bool held = joint.type == JointType::prismatic && f.radius > 0.0;
  const double load = f.preload + (held ? std::abs(reaction.torque.dot(e)) / f.radius : 0.0);
  if (f.length <= 0.0) return load + across.norm();
  const Vector3d pair = e.cross(reaction.torque) / f.length;
  return load + (0.5 * across + pair).norm() + (0.5 * across - pair).norm();
}

}  // namespace

NewtonEulerCheck::NewtonEulerCheck(const Linkage& linkage) : linkage_(linkage) {
  for (const int index : tree_order(linkage_)) {
    const Joint& joint = linkage_.joints[static_cast<std::size_t>(index)];
    places_.push_back({index, nq_, nv_});
    nq_ += position_count(joint.type, joint.coordinates);
    nv_ += velocity_count(joint.type);
  }
  for (const char* part : {".q", ".v", ".a"}) {
    for (const Place& place : places_) {
      const Joint& joint = joint_at(place);
      if (joint.type != JointType::fixed) signals_.push_back("joint." + joint.name + part);
    }
  }
  for (const Closure& c : linkage_.closures) {
    signals_.push_back("closure." + c.name + ".force");
    signals_.push_back("closure." + c.name + ".torque");
  }
  int column = nq_ + 2 * nv_ + 6 * static_cast<int>(linkage_.closures.size());
  for (Place& place : places_) {
    const Joint& joint = joint_at(place);
    if (!joint.friction) continue;
    signals_.push_back("joint." + joint.name + ".normal_load");
    signals_.push_back("joint." + joint.name + ".friction");
    place.friction = column;
    column += 1 + velocity_count(joint.type);
  }
}

const Joint& NewtonEulerCheck::joint_at(const Place& place) const {
  return linkage_.joints[static_cast<std::size_t>(place.joint)];
}

std::vector<LinkMotion> NewtonEulerCheck::motions(const Vector& sample) const {
  return link_motions(linkage_, sample.head(nq_), sample.segment(nq_, nv_),
                      sample.segment(nq_ + nv_, nv_));
}

// Force and torque on the first link at its point, the opposite on the second.
std::vector<ExternalWrench> NewtonEulerCheck::closure_wrenches(
    const std::vector<LinkMotion>& motions, const Vector& sample) const {
  std::vector<ExternalWrench> wrenches;
  int column = nq_ + 2 * nv_;
  for (const Closure& c : linkage_.closures) {
    const LinkMotion& first = motion_of(motions, c.first.link);
    const Vector3d point = first.p + first.R * c.first.frame.position;
    const Vector3d force = sample.segment<3>(column), torque = sample.segment<3>(column + 3);
    wrenches.push_back({c.first.link, point, force, torque});
    wrenches.push_back({c.second.link, point, -force, -torque});
    column += 6;
  }
  return wrenches;
}

double NewtonEulerCheck::applied(const Place& place, int k, double t, const Vector& sample) const {
  const Joint& joint = joint_at(place);
  const double q = sample[place.q + k], v = sample[nq_ + place.v + k];
  double sum =
      -entry(joint.stiffness, k) * (q - entry(joint.rest, k)) - entry(joint.damping, k) * v;
  for (const Load& load : linkage_.loads) {
    if (load.joint != joint.name || load.coordinate != k) continue;
    if (load.type == LoadType::drive) sum += course_value(load.course, t);
    if (load.type == LoadType::resistance) sum -= resistance_value(load.law, v);
  }
  return place.friction < 0 ? sum : sum - sample[place.friction + 1 + k];
}

NewtonEulerCheck::Residual NewtonEulerCheck::at(double t, const Vector& sample) const {
  const std::vector<LinkMotion> moving = motions(sample);
  const Reactions reactions = joint_reactions(linkage_, moving, closure_wrenches(moving, sample));
  Residual worst;
  for (const Place& place : places_) {
    const Joint& joint = joint_at(place);
    const JointReaction& reaction = reaction_of(reactions, joint.name);
    Matrix3d R = joint.frame.rotation;
    if (joint.parent != kGround) R = motion_of(moving, joint.parent).R * R;
    const auto axes = coordinate_axes(joint.type, R, sample.data() + place.q);
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const double along = axes[k].force.dot(reaction.force) + axes[k].torque.dot(reaction.torque);
      const double rest = along - applied(place, static_cast<int>(k), t, sample);
      worst.generalised = std::max(worst.generalised, std::abs(rest));
    }
    worst.reaction = std::max(worst.reaction, reaction.force.norm());
    if (place.friction < 0) continue;
    const double load = normal_load(joint, reaction, R.col(2));
    worst.load = std::max(worst.load, std::abs(load - sample[place.friction]));
  }
  return worst;
}

}  // namespace linkstudy::testing
