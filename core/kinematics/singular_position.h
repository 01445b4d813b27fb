// Positions where the drives do not decide the motion ([Palcak] (4.108)-(4.110)).
//   lock    h < h_R: the drives cannot go on; the closed poses turn back there
//   branch  h = h_R below the rank of regular poses: other motions cross while the drives rest
//   stop    neither: the pose is regular, but it could not be continued
// A lock is the turning point of the curve of closed poses (pose_curve.h), found where the rate of
// the drives is zero.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/kinematics/driven_motion.h"

namespace linkstudy {

enum class SingularKind { lock, branch, stop };

struct SingularPosition {
  SingularKind kind = SingularKind::branch;
  double time = 0.0;                // of the course, s
  State<double> s;                  // the pose
  Eigen::VectorXd drive;            // (n) driven coordinates, rad or m
  double quality = 0.0;             // transmission quality there
  DriveRanks ranks;                 // there
  int regular_rank = 0;             // of M where it is largest
  std::vector<std::string> joints;  // that can move while the drives rest
  // Angles that are singular there (three_turns.h): then it is one of the coordinates, perhaps not
  // of the linkage.
  std::vector<std::string> angles;
};

// Judges a pose by its ranks.
SingularPosition describe_singular(const DrivenLinkage& linkage, double time,
                                   const State<double>& s);

// The pose near s where the drives, moving along `direction` (n, without dimensions), turn back.
// Nothing if there is none near, or if the linkage has freedoms that nobody drives.
std::optional<State<double>> find_turning_pose(const DrivenLinkage& linkage, const State<double>& s,
                                               const Eigen::VectorXd& direction);

}  // namespace linkstudy
