#include "tests/support/least_reactions.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "tests/support/free_bodies.h"
#include "tests/support/trace_model.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// A joint wherever it is cut: bears on `child`, at `point`, with axes whose last is its own.
struct AnyJoint {
  std::string name, child, parent;
  JointType type;
  Vector3d point;
  Matrix3d axes;
  double along = 0.0;  // known moment about the axis of a revolute, on the child
};

std::vector<AnyJoint> all_joints(const Linkage& linkage, const std::vector<LinkMotion>& motions,
                                 const InstantOfMotion& s) {
  std::vector<AnyJoint> all;
  Eigen::Index k = 0;
  for (const int j : tree_order(linkage)) {
    const Joint& joint = linkage.joints[static_cast<std::size_t>(j)];
    const LinkMotion& child = motion_of(motions, joint.child);
    all.push_back({joint.name, joint.child, joint.parent, joint.type,
                   point_motion(child, joint.child_frame.position).p,
                   child.R * joint.child_frame.rotation});
    if (!joint.damping.empty()) all.back().along = -joint.damping[0] * s.v[k];
    k += velocity_count(joint.type);
  }
  for (const Closure& c : linkage.closures) {
    const bool fixed = c.first.link == kGround;
    const Frame& f = c.first.frame;
    const Matrix3d R = fixed ? f.rotation : motion_of(motions, c.first.link).R * f.rotation;
    Matrix3d axes;
    axes << R.col(1), R.col(2), R.col(0);
    all.push_back(
        {c.name, c.first.link, c.second.link, c.type,
         fixed ? f.position : point_motion(motion_of(motions, c.first.link), f.position).p, axes});
  }
  return all;
}

// Wrench directions in a joint's axes, force over l and moment; zero where it is free.
Matrix6 blocked(const AnyJoint& joint, double l) {
  Matrix6 all = Matrix6::Zero();
  all.topLeftCorner<3, 3>() = joint.axes / l;
  all.bottomRightCorner<3, 3>() = joint.axes;
  switch (joint.type) {
    case JointType::revolute:
      all.col(5).setZero();
      return all;
    case JointType::prismatic:
      all.col(2).setZero();
      return all;
    case JointType::spherical:
      all.rightCols<3>().setZero();
      return all;
    case JointType::fixed:
      return all;
    default:
      throw std::invalid_argument("joint type");
  }
}

Vector6 along_axis(const AnyJoint& joint) {
  Vector6 f = Vector6::Zero();
  f.tail<3>() = joint.along * joint.axes.col(2);
  return f;
}

double spread(const std::vector<AnyJoint>& joints, const std::set<std::string>& bridges) {
  Vector3d sum = Vector3d::Zero();
  double square = 0.0, n = 0.0;
  for (const AnyJoint& j : joints) {
    if (bridges.contains(j.name)) continue;
    sum += j.point;
    n += 1.0;
  }
  for (const AnyJoint& j : joints) {
    if (!bridges.contains(j.name)) square += (j.point - sum / n).squaredNorm() / n;
  }
  return std::sqrt(square);
}

}  // namespace

JointWrenches least_reactions(const Linkage& linkage, const InstantOfMotion& s,
                              const std::set<std::string>& bridges) {
  const auto motions = link_motions(linkage, s.q, s.v, s.a);
  const std::vector<AnyJoint> joints = all_joints(linkage, motions, s);
  const double l = spread(joints, bridges);
  const auto n = static_cast<Eigen::Index>(linkage.links.size());
  const auto columns = 6 * static_cast<Eigen::Index>(joints.size());
  Matrix A = Matrix::Zero(6 * n, columns);  // a joint's columns beyond what it blocks stay zero
  Vector b(6 * n);
  std::vector<Matrix6> bases;
  for (const AnyJoint& joint : joints) bases.push_back(blocked(joint, l));
  for (Eigen::Index i = 0; i < n; ++i) {
    const Link& link = linkage.links[static_cast<std::size_t>(i)];
    const LinkMotion& motion = motion_of(motions, link.name);
    const Vector3d C = point_motion(motion, link.center_of_mass).p;
    b.segment<6>(6 * i) = inertial_wrench(link, motion, linkage.gravity);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const double sign = joints[j].child == link.name    ? 1.0
                          : joints[j].parent == link.name ? -1.0
                                                          : 0.0;
      const Matrix6 shift = sign * lever(joints[j].point, C);
      A.block<6, 6>(6 * i, 6 * static_cast<Eigen::Index>(j)) = shift * bases[j];
      b.segment<6>(6 * i) -= shift * along_axis(joints[j]);
    }
  }
  const Vector x = A.completeOrthogonalDecomposition().solve(b);
  EXPECT_LT((A * x - b).norm(), 1e-9 * (1.0 + b.norm())) << linkage.name << ": no such motion";
  JointWrenches reactions;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    reactions[joints[j].name] =
        bases[j] * x.segment<6>(6 * static_cast<Eigen::Index>(j)) + along_axis(joints[j]);
  }
  return reactions;
}

}  // namespace linkstudy::testing
