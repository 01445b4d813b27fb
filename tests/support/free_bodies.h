// Newton and Euler for every link by itself: a second route to reactions, energy and momentum that
// shares no formula with the trace oracle. Motions come from a recursion over ground-axes vectors;
// all joint reactions together from one dense system, per link with centre of mass C:
//   sum F = m (a_C - g),   sum N_C = I alpha + omega x I omega
// A reaction is the total wrench that a joint transmits from parent to child, drives and
// resistances in that joint included: force and torque on the child at the origin of the joint
// frame in the child, ground axes, N and N m.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct LinkMotion {
  std::string link;
  Eigen::Matrix3d R;             // link -> ground
  Eigen::Vector3d p, v, a;       // of the link origin, ground axes
  Eigen::Vector3d omega, alpha;  // ground axes
};

// q (nq), v, a (nv) in the linkage's own coordinates, zyx or quaternion, stacked in tree order.
// Links come in tree order. Quaternions are normalised first.
std::vector<LinkMotion> link_motions(const Linkage& linkage, const Eigen::VectorXd& q,
                                     const Eigen::VectorXd& v, const Eigen::VectorXd& a);

const LinkMotion& motion_of(const std::vector<LinkMotion>& motions, const std::string& link);

// Position, velocity, acceleration of a point of a link, ground axes.
struct PointMotion {
  Eigen::Vector3d p, v, a;
};
PointMotion point_motion(const LinkMotion& link, const Eigen::Vector3d& point);

// The part of one wrench (F, N) at `point` in the six balances of a link about C.
Eigen::Matrix<double, 6, 6> lever(const Eigen::Vector3d& point, const Eigen::Vector3d& C);

// m (a_C - g) and I alpha + omega x I omega.
Eigen::Matrix<double, 6, 1> inertial_wrench(const Link& body, const LinkMotion& link,
                                            const Eigen::Vector3d& gravity);

// Force at a point and torque on a link; point, force, torque in the ground frame.
struct ExternalWrench {
  std::string link;
  Eigen::Vector3d point, force, torque;
};

// link_force and link_torque loads at time t.
std::vector<ExternalWrench> load_wrenches(const Linkage& linkage,
                                          const std::vector<LinkMotion>& motions, double t);

struct JointReaction {
  std::string joint;
  Eigen::Vector3d origin, force, torque;
};
struct Reactions {
  std::vector<JointReaction> joints;  // in tree order
  double residual = 0.0;              // of the dense system, N or N m
};
Reactions joint_reactions(const Linkage& linkage, const std::vector<LinkMotion>& motions,
                          const std::vector<ExternalWrench>& wrenches);

const JointReaction& reaction_of(const Reactions& reactions, const std::string& joint);

struct Momentum {
  Eigen::Vector3d linear, angular;  // angular about the ground origin
};
double kinetic_energy(const Linkage& linkage, const std::vector<LinkMotion>& motions);
double gravity_energy(const Linkage& linkage, const std::vector<LinkMotion>& motions);
Momentum momentum(const Linkage& linkage, const std::vector<LinkMotion>& motions);

}  // namespace linkstudy::testing
