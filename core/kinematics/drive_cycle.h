// A linkage along the course of its drive: continuation from the assembled start.
//
// Each step predicts y + h t + h^2/2 c and corrects by Newton-Raphson; it is taken if the
// correction is small and the new velocities continue the old ones, so that the branch of the start
// is kept, and tried again at half the length otherwise. Where steps vanish while the velocities of
// the dependent joints grow without bound the linkage is locked: the drive cannot go on. Where they
// stay bounded, or where the transmission quality passes through zero between steps, other branches
// cross: the singular position is found as the minimum of the quality on the interpolated motion.
#pragma once

#include <string>
#include <vector>

#include "core/kinematics/driven_motion.h"

namespace linkstudy {

enum class SingularKind { lock, branch };

struct SingularPosition {
  SingularKind kind = SingularKind::branch;
  double drive = 0.0;               // driven coordinate, rad or m
  double quality = 0.0;             // transmission quality there
  std::vector<std::string> joints;  // that can move while the drive rests
};

struct CourseOptions {
  double from = 0.0, to = 0.0;  // driven coordinate, rad or m
  int positions = 73;           // evenly spaced, both ends included; at least 2
  // Where the way to `to` is locked, also go from `from` the other way until it is locked there.
  bool both_ways = false;
};

struct DriveCycle {
  std::vector<DrivenPose> poses;  // in the order from -> to, those that can be reached
  std::vector<SingularPosition> singular;
  bool is_reached = false;  // `from`: without it there are no poses
  bool is_complete = false;
};

DriveCycle follow_drive(const DrivenLinkage& linkage, const State<double>& start,
                        const MobilityReport& mobility, const CourseOptions& options);

}  // namespace linkstudy
