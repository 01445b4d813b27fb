// Coordinates of the joint that closes a loop: the motion P of {2,e} in {1,e},
//   shifts along the axes of {1,e} that the joint leaves free, in the order x y z;
//   then phi about x (revolute, cylindrical, planar joints), phi and theta about x and the new y
//   (universal), or Euler parameters w x y z (spherical).
// Rates of Euler parameters are the angular velocity of {2,e} in {1,e}, in axes of {2,e}, as those
// of tree joints with a quaternion. Units: m, rad.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/model/parameters.h"
#include "core/model/workspace.h"

namespace linkstudy {

struct CutJoint {
  std::vector<int> shifts;  // 0 1 2 for x y z
  int turns = 0;            // free rotations: 0, 1, 2, 3

  int position_count() const { return static_cast<int>(shifts.size()) + turns + (turns == 3); }
  int velocity_count() const { return static_cast<int>(shifts.size()) + turns; }
};

// Directions that the cut rows of a closure block, as a bit mask (bit d for Direction d).
unsigned blocked_directions(const Mechanism& m, const ClosureStructure& c);

// Of a closure that counts as the exact joint of its type.
CutJoint cut_joint_of(const Mechanism& m, ClosureIndex closure);

// Pose of {1,e} or {2,e} in ground axes.
struct ClosureFrame {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d position;
};
ClosureFrame first_frame(const ClosureState<double>& x);
ClosureFrame second_frame(const ClosureState<double>& x);

// Coordinates at two poses (the free part of the motion between them), and {2,e} from them.
Eigen::VectorXd cut_joint_position(const CutJoint& joint, const ClosureFrame& first,
                                   const ClosureFrame& second);
ClosureFrame moved_by(const CutJoint& joint, const Eigen::VectorXd& position,
                      const ClosureFrame& first);

// Twists (omega; velocity of the origin of {2,e}) by unit rates, ground axes: (6, velocity_count).
Eigen::MatrixXd cut_joint_twists(const CutJoint& joint, const ClosureFrame& first,
                                 const ClosureFrame& second);

// Motion of a closure frame, ground axes.
struct FrameMotion {
  ClosureFrame pose;
  Eigen::Vector3d velocity, acceleration;  // of its origin
  Eigen::Vector3d omega, alpha;
};
struct CutJointMotion {
  Eigen::VectorXd position, velocity, acceleration;
};
CutJointMotion cut_joint_motion(const CutJoint& joint, const FrameMotion& first,
                                const FrameMotion& second);

// Of all closures, in their order. q (nq), v (nv), qdd (nv) in SI.
std::vector<CutJointMotion> cut_joint_motions(const Mechanism& m, const Parameters<double>& p,
                                              const double* q, const double* v, const double* qdd);

// Angles by full turns, Euler parameters by their sign, so that they continue a position before.
void continue_position(const CutJoint& joint, const Eigen::VectorXd& before,
                       Eigen::VectorXd& position);

}  // namespace linkstudy
