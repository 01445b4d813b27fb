#include "core/kinematics/cut_joint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/kinematics/body_accelerations.h"
#include "core/kinematics/closure_kinematics.h"
#include "core/spatial/euler_parameters.h"
#include "core/spatial/to_eigen.h"

namespace linkstudy {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Rates of the free rotations and their derivatives: with x of {1,e} and y of {2,e} at right angles
//   omega_2 - omega_1 = phi_dot x_1 + theta_dot y_2
void add_turns(const FrameMotion& first, const FrameMotion& second, int turns, int at,
               CutJointMotion& motion) {
  const Vector3d omega = second.omega - first.omega, alpha = second.alpha - first.alpha;
  const Matrix3d& r2 = second.pose.rotation;
  if (turns == 3) {
    motion.velocity.segment<3>(at) = r2.transpose() * omega;
    motion.acceleration.segment<3>(at) = r2.transpose() * (alpha - second.omega.cross(omega));
    return;
  }
  const Vector3d x = first.pose.rotation.col(0), y = r2.col(1);
  const double phi = omega.dot(x), theta = turns == 2 ? omega.dot(y) : 0.0;
  if (turns > 0) {
    motion.velocity[at] = phi;
    motion.acceleration[at] = alpha.dot(x) - theta * second.omega.cross(y).dot(x);
  }
  if (turns > 1) {
    motion.velocity[at + 1] = theta;
    motion.acceleration[at + 1] = alpha.dot(y) - phi * first.omega.cross(x).dot(y);
  }
}

// A frame fixed in a body, by the body's motion with true accelerations but for gravity.
FrameMotion frame_motion(const ClosureFrame& pose, const BodyState<double>& body) {
  const Vector3d arm = pose.position - to_eigen(body.p_WB);
  FrameMotion f{pose, to_eigen(body.v_WB), to_eigen(body.a_WB), to_eigen(body.w_WB),
                to_eigen(body.alpha_WB)};
  const Vector3d carried = f.omega.cross(arm);
  f.velocity += carried;
  f.acceleration += f.alpha.cross(arm) + f.omega.cross(carried);
  return f;
}

}  // namespace

unsigned blocked_directions(const Mechanism& m, const ClosureStructure& c) {
  unsigned blocked = 0;
  for (const RowIndex r : rows_of(c)) blocked |= 1u << m.cut_rows[r].direction;
  return blocked;
}

CutJoint cut_joint_of(const Mechanism& m, ClosureIndex closure) {
  const unsigned blocked = blocked_directions(m, m.closures[closure]);
  CutJoint joint;
  for (int d = 0; d < kDirections; ++d) {
    if (blocked >> d & 1u) continue;
    if (d <= kZ) joint.shifts.push_back(d);
    if (d > kZ) ++joint.turns;
  }
  return joint;
}

ClosureFrame first_frame(const ClosureState<double>& x) {
  return {to_eigen(x.R_WF), to_eigen(x.p_WF)};
}

ClosureFrame second_frame(const ClosureState<double>& x) {
  return {to_eigen(x.R_WS), to_eigen(x.p_WS)};
}

VectorXd cut_joint_position(const CutJoint& joint, const ClosureFrame& first,
                            const ClosureFrame& second) {
  const Matrix3d r = first.rotation.transpose() * second.rotation;
  const Vector3d d = first.rotation.transpose() * (second.position - first.position);
  VectorXd q(joint.position_count());
  int at = 0;
  for (const int axis : joint.shifts) q[at++] = d[axis];
  if (joint.turns == 3) {
    q.segment<4>(at) = euler_parameters(r);
    return q;
  }
  // R = Rx(phi) Ry(theta)
  if (joint.turns > 0) q[at++] = std::atan2(r(2, 1), r(1, 1));
  if (joint.turns > 1) q[at] = std::atan2(r(0, 2), r(0, 0));
  return q;
}

ClosureFrame moved_by(const CutJoint& joint, const VectorXd& position, const ClosureFrame& first) {
  Vector3d d = Vector3d::Zero();
  Matrix3d r = Matrix3d::Identity();
  int at = 0;
  for (const int axis : joint.shifts) d[axis] = position[at++];
  if (joint.turns == 3) {
    r = direction_cosines(position.segment<4>(at));
  } else {
    if (joint.turns > 0) r = Eigen::AngleAxisd(position[at++], Vector3d::UnitX());
    if (joint.turns > 1) r = r * Eigen::AngleAxisd(position[at], Vector3d::UnitY());
  }
  return {first.rotation * r, first.position + first.rotation * d};
}

MatrixXd cut_joint_twists(const CutJoint& joint, const ClosureFrame& first,
                          const ClosureFrame& second) {
  MatrixXd twists = MatrixXd::Zero(6, joint.velocity_count());
  int at = 0;
  for (const int axis : joint.shifts) twists.col(at++).tail<3>() = first.rotation.col(axis);
  if (joint.turns == 3) {
    twists.block<3, 3>(0, at) = second.rotation;
    return twists;
  }
  if (joint.turns > 0) twists.col(at++).head<3>() = first.rotation.col(0);
  if (joint.turns > 1) twists.col(at).head<3>() = second.rotation.col(1);
  return twists;
}

CutJointMotion cut_joint_motion(const CutJoint& joint, const FrameMotion& first,
                                const FrameMotion& second) {
  const int n = joint.velocity_count();
  CutJointMotion motion{cut_joint_position(joint, first.pose, second.pose), VectorXd(n),
                        VectorXd(n)};
  // The gap seen from {1,e}, which turns.
  const Vector3d gap = second.pose.position - first.pose.position;
  const Vector3d carried = first.omega.cross(gap);
  const Vector3d rate = second.velocity - first.velocity - carried;
  const Vector3d acceleration = second.acceleration - first.acceleration - first.alpha.cross(gap) -
                                first.omega.cross(2.0 * rate + carried);
  int at = 0;
  for (const int axis : joint.shifts) {
    motion.velocity[at] = first.pose.rotation.col(axis).dot(rate);
    motion.acceleration[at++] = first.pose.rotation.col(axis).dot(acceleration);
  }
  add_turns(first, second, joint.turns, at, motion);
  return motion;
}

std::vector<CutJointMotion> cut_joint_motions(const Mechanism& m, const Parameters<double>& p,
                                              const double* q, const double* v, const double* qdd) {
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, p, q, v, w);
  std::copy(qdd, qdd + m.nv, w.qdd.begin());
  BodyStates<double> moving;
  update_body_accelerations(m, p, w, moving);
  std::vector<CutJointMotion> motions;
  for (const ClosureIndex i : indices_of(m.closures)) {
    ClosureStructure c = m.closures[i];
    c.needs_frames = true;
    ClosureState<double> x{};
    update_closure_pose(m, c, p.closures[i], w.bodies, x);
    motions.push_back(cut_joint_motion(cut_joint_of(m, i),
                                       frame_motion(first_frame(x), moving[c.first]),
                                       frame_motion(second_frame(x), moving[c.second])));
  }
  return motions;
}

void continue_position(const CutJoint& joint, const VectorXd& before, VectorXd& position) {
  const auto shifts = static_cast<int>(joint.shifts.size());
  if (joint.turns == 3) {
    if (before.tail<4>().dot(position.tail<4>()) < 0.0) position.tail<4>() *= -1.0;
    return;
  }
  for (int i = shifts; i < shifts + joint.turns; ++i) {
    position[i] = before[i] + std::remainder(position[i] - before[i], 2.0 * std::numbers::pi);
  }
}

}  // namespace linkstudy
