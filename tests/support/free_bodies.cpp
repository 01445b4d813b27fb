#include "tests/support/free_bodies.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "tests/support/trace_loads.h"
#include "tests/support/trace_model.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A frame that is carried along a chain; every member in ground axes.
struct Moving {
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero(), v = Vector3d::Zero(), a = Vector3d::Zero();
  Vector3d omega = Vector3d::Zero(), alpha = Vector3d::Zero();
};

Moving offset(Moving m, const Vector3d& position, const Matrix3d& rotation) {
  const Vector3d r = m.R * position;
  m.p += r;
  m.v += m.omega.cross(r);
  m.a += m.alpha.cross(r) + m.omega.cross(m.omega.cross(r));
  m.R = m.R * rotation;
  return m;
}

struct Coordinate {
  double q, v, a;
};

// Moves along axis k of the frame; the frame keeps its orientation.
Moving slide(Moving m, int k, const Coordinate& s) {
  const Vector3d e = m.R.col(k);
  m.p += e * s.q;
  m.v += m.omega.cross(e * s.q) + e * s.v;
  m.a += m.alpha.cross(e * s.q) + m.omega.cross(m.omega.cross(e * s.q)) +
         2.0 * m.omega.cross(e * s.v) + e * s.a;
  return m;
}

// Turns about axis k of the frame.
Moving turn(Moving m, int k, const Coordinate& s) {
  const Vector3d e = m.R.col(k);
  m.alpha += e * s.a + m.omega.cross(e * s.v);
  m.omega += e * s.v;
  m.R = Eigen::AngleAxisd(s.q, e).toRotationMatrix() * m.R;
  return m;
}

// Turns by a quaternion with angular velocity and acceleration in the turned axes.
Moving turn_freely(Moving m, const Eigen::Vector4d& wxyz, const Vector3d& w, const Vector3d& dw) {
  const Eigen::Quaterniond quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  m.R = m.R * quaternion.normalized().toRotationMatrix();
  m.alpha += m.R * dw + m.omega.cross(m.R * w);
  m.omega += m.R * w;
  return m;
}

// Reads the coordinates of the joints one after the other.
struct Reader {
  const Eigen::VectorXd &q, &v, &a;
  int nq = 0, nv = 0;
  Coordinate next() {
    const Coordinate s{q[nq], v[nv], a[nv]};
    ++nq;
    ++nv;
    return s;
  }
};

Moving turn_ball(Moving m, const Joint& joint, Reader& read) {
  if (joint.coordinates == RotationCoordinates::zyx) {
    for (const int k : {2, 1, 0}) m = turn(m, k, read.next());
    return m;
  }
  m = turn_freely(m, read.q.segment<4>(read.nq), read.v.segment<3>(read.nv),
                  read.a.segment<3>(read.nv));
  read.nq += 4;
  read.nv += 3;
  return m;
}

Moving turn_screw(const Moving& m, double pitch, const Coordinate& s) {
  return slide(turn(m, 2, s), 2, {pitch * s.q, pitch * s.v, pitch * s.a});
}

Moving joint_motion(Moving m, const Joint& joint, Reader& read) {
  switch (joint.type) {
    case JointType::revolute:
      return turn(m, 2, read.next());
    case JointType::prismatic:
      return slide(m, 2, read.next());
    case JointType::cylindrical:
      m = turn(m, 2, read.next());
      return slide(m, 2, read.next());
    case JointType::universal:
      m = turn(m, 2, read.next());
      return turn(m, 1, read.next());
    case JointType::spherical:
      return turn_ball(m, joint, read);
    case JointType::planar:
      m = slide(m, 0, read.next());
      m = slide(m, 1, read.next());
      return turn(m, 2, read.next());
    case JointType::free:
      for (int k = 0; k < 3; ++k) m = slide(m, k, read.next());
      return turn_ball(m, joint, read);
    case JointType::fixed:
    case JointType::pin_in_slot:  // of closures
    case JointType::rod:
      return m;
    case JointType::screw:
      return turn_screw(m, joint.pitch, read.next());
  }
  return m;
}

const Link& body_of(const Linkage& linkage, const std::string& name) {
  for (const Link& link : linkage.links)
    if (link.name == name) return link;
  throw std::invalid_argument(fmt::format("free bodies: no link '{}'", name));
}

Matrix3d cross_matrix(const Vector3d& r) {
  Matrix3d S;
  S << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return S;
}

int index_of(const std::vector<LinkMotion>& motions, const std::string& link) {
  for (std::size_t k = 0; k < motions.size(); ++k) {
    if (motions[k].link == link) return static_cast<int>(k);
  }
  return -1;
}

}  // namespace

std::vector<LinkMotion> link_motions(const Linkage& linkage, const Eigen::VectorXd& q,
                                     const Eigen::VectorXd& v, const Eigen::VectorXd& a) {
  Reader read{q, v, a};
  std::vector<LinkMotion> motions;
  for (const int j : tree_order(linkage)) {
    const Joint& joint = linkage.joints[j];
    Moving m;
    if (joint.parent != kGround) {
      const LinkMotion& parent = motion_of(motions, joint.parent);
      m = {parent.R, parent.p, parent.v, parent.a, parent.omega, parent.alpha};
    }
    m = offset(m, joint.frame.position, joint.frame.rotation);
    m = joint_motion(m, joint, read);
    const Matrix3d back = joint.child_frame.rotation.transpose();
    m = offset(m, -back * joint.child_frame.position, back);
    motions.push_back({joint.child, m.R, m.p, m.v, m.a, m.omega, m.alpha});
  }
  return motions;
}

const LinkMotion& motion_of(const std::vector<LinkMotion>& motions, const std::string& link) {
  const int k = index_of(motions, link);
  if (k < 0) throw std::invalid_argument(fmt::format("free bodies: no motion of '{}'", link));
  return motions[k];
}

PointMotion point_motion(const LinkMotion& link, const Eigen::Vector3d& point) {
  const Vector3d r = link.R * point;
  return {link.p + r, link.v + link.omega.cross(r),
          link.a + link.alpha.cross(r) + link.omega.cross(link.omega.cross(r))};
}

Eigen::Matrix<double, 6, 6> lever(const Vector3d& point, const Vector3d& C) {
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Identity();
  A.bottomLeftCorner<3, 3>() = cross_matrix(point - C);
  return A;
}

Eigen::Matrix<double, 6, 1> inertial_wrench(const Link& body, const LinkMotion& link,
                                            const Vector3d& gravity) {
  const Matrix3d I = link.R * body.inertia * link.R.transpose();
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << body.mass * (point_motion(link, body.center_of_mass).a - gravity),
      I * link.alpha + link.omega.cross(I * link.omega);
  return wrench;
}

std::vector<ExternalWrench> load_wrenches(const Linkage& linkage,
                                          const std::vector<LinkMotion>& motions, double t) {
  std::vector<ExternalWrench> wrenches;
  for (const Load& load : linkage.loads) {
    if (load.type != LoadType::link_force && load.type != LoadType::link_torque) continue;
    const LinkMotion& link = motion_of(motions, load.link);
    const Vector3d direction = load.follows_link ? link.R * load.direction : load.direction;
    const Vector3d value = course_value(load.course, t) * direction;
    const bool force = load.type == LoadType::link_force;
    wrenches.push_back({load.link, point_motion(link, load.point).p,
                        force ? value : Vector3d::Zero(), force ? Vector3d::Zero() : value});
  }
  return wrenches;
}

Reactions joint_reactions(const Linkage& linkage, const std::vector<LinkMotion>& motions,
                          const std::vector<ExternalWrench>& wrenches) {
  const int n = static_cast<int>(motions.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  Eigen::VectorXd right(6 * n);
  std::vector<Vector3d> C(n);
  for (int k = 0; k < n; ++k) {
    const Link& body = body_of(linkage, motions[k].link);
    C[k] = point_motion(motions[k], body.center_of_mass).p;
    right.segment<6>(6 * k) = inertial_wrench(body, motions[k], linkage.gravity);
  }
  for (const ExternalWrench& wrench : wrenches) {
    const int k = index_of(motions, wrench.link);
    if (k < 0) continue;  // the ground
    Eigen::Matrix<double, 6, 1> FN;
    FN << wrench.force, wrench.torque;
    right.segment<6>(6 * k) -= lever(wrench.point, C[k]) * FN;
  }
  Reactions reactions;
  for (const int j : tree_order(linkage)) {
    const Joint& joint = linkage.joints[j];
    const int child = index_of(motions, joint.child);
    const int parent = index_of(motions, joint.parent);
    const Vector3d origin = point_motion(motions[child], joint.child_frame.position).p;
    A.block<6, 6>(6 * child, 6 * child) += lever(origin, C[child]);
    if (parent >= 0) A.block<6, 6>(6 * parent, 6 * child) -= lever(origin, C[parent]);
    reactions.joints.push_back({joint.name, origin, Vector3d::Zero(), Vector3d::Zero()});
  }
  const Eigen::VectorXd x = A.completeOrthogonalDecomposition().solve(right);
  reactions.residual = (A * x - right).norm();
  for (int k = 0; k < n; ++k) {
    reactions.joints[k].force = x.segment<3>(6 * k);
    reactions.joints[k].torque = x.segment<3>(6 * k + 3);
  }
  return reactions;
}

const JointReaction& reaction_of(const Reactions& reactions, const std::string& joint) {
  for (const JointReaction& reaction : reactions.joints) {
    if (reaction.joint == joint) return reaction;
  }
  throw std::invalid_argument(fmt::format("free bodies: no joint '{}'", joint));
}

double kinetic_energy(const Linkage& linkage, const std::vector<LinkMotion>& motions) {
  double energy = 0.0;
  for (const LinkMotion& link : motions) {
    const Link& body = body_of(linkage, link.link);
    const Vector3d w = link.R.transpose() * link.omega;
    energy += 0.5 * body.mass * point_motion(link, body.center_of_mass).v.squaredNorm() +
              0.5 * w.dot(body.inertia * w);
  }
  return energy;
}

double gravity_energy(const Linkage& linkage, const std::vector<LinkMotion>& motions) {
  double energy = 0.0;
  for (const LinkMotion& link : motions) {
    const Link& body = body_of(linkage, link.link);
    energy -= body.mass * linkage.gravity.dot(point_motion(link, body.center_of_mass).p);
  }
  return energy;
}

Momentum momentum(const Linkage& linkage, const std::vector<LinkMotion>& motions) {
  Momentum total{Vector3d::Zero(), Vector3d::Zero()};
  for (const LinkMotion& link : motions) {
    const Link& body = body_of(linkage, link.link);
    const PointMotion C = point_motion(link, body.center_of_mass);
    total.linear += body.mass * C.v;
    total.angular +=
        C.p.cross(body.mass * C.v) + link.R * body.inertia * (link.R.transpose() * link.omega);
  }
  return total;
}

}  // namespace linkstudy::testing
