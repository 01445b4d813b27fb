// Closures of a linkage by products of transforms and their derivatives.
// Every row is a scalar deformation d(q) of the second frame relative to the first; the closure
// enters the equations of motion as -d_q^T s, where s is a multiplier ([Urbas16] eq. (18.3), signs
// as there: s acts on the first body) or C d + B d_dot (eq. (14)).
//   translations  r2 - r1 in ground axes (eq. (7)) or in the axes of {1,e}, R1^T (r2 - r1)
//   rotations     with R = R1^T R2: linearized phi R21, theta R02, psi R10 (eq. (12));
//                 axis phi R21, theta -R20, psi R10, and -R01 for psi of a universal closure
// A cut joint takes ground axes where all translations are blocked, else those of {1,e}, and the
// axis measure. Forces and torques are those on `first`, ground axes, N and N m.
#pragma once

#include "tests/support/trace_kinematics.h"

namespace linkstudy::testing {

struct ClosureFrames {
  CarriedFrame first;   // T(1,e)
  CarriedFrame second;  // T(2,e)
};
ClosureFrames closure_frames(const TraceModel& model, const TraceClosure& closure,
                             const std::vector<LinkTransform>& transforms, const Vector& v);

struct ClosureRow {
  double d = 0.0;       // m or 1
  Vector d_q;           // (dof)
  double d_dot = 0.0;   // sum_k d_k v_k
  double d_vv = 0.0;    // sum_kl d_kl v_k v_l
  Eigen::Vector3d arm;  // force (translation) or torque (rotation) on first for s = 1
  bool rotation = false;
};

ClosureRow translation_row(const ClosureFrames& frames, Direction direction, SdeAxes axes);
ClosureRow rotation_row(const ClosureFrames& frames, Direction direction, TiltMeasure tilt,
                        JointType type);

// Rows of a cut joint in the order of Direction.
std::vector<ClosureRow> cut_rows(const ClosureFrames& frames, JointType type);

// What a closure does to the linkage.
struct ClosureResult {
  std::string name;
  Vector multipliers;                                      // cut: one a row
  Vector generalised;                                      // on the tree's coordinates, (dof)
  Eigen::Vector3d force = Eigen::Vector3d::Zero();         // on first
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();        // on first, of the rotational rows only
  Eigen::Vector3d point_first = Eigen::Vector3d::Zero();   // where force acts on first, ground axes
  Eigen::Vector3d point_second = Eigen::Vector3d::Zero();  // where -force acts on second
  Eigen::Vector3d gap = Eigen::Vector3d::Zero();           // r2 - r1, ground axes, m
  double energy = 0.0;                                     // stored in the element, J
  double dissipated_power = 0.0;                           // W, not negative
};

ClosureResult sde_result(const TraceClosure& closure, const ClosureFrames& frames);
ClosureResult cut_result(const TraceClosure& closure, const ClosureFrames& frames,
                         const std::vector<ClosureRow>& rows, const Vector& multipliers);

// b = 2 zeta sqrt(c m_eff), m_eff = 1 / max eig(J M^-1 J^T) over the stiff rows at q, translations
// and rotations apart.
std::array<double, kDirections> damping_of_ratio(const TraceModel& model,
                                                 const TraceClosure& closure, const Vector& q);

}  // namespace linkstudy::testing
