// A linkage along the course of its drives: continuation from the assembled start.
//
// Each step takes the drives straight to their place on the course at a later time. It predicts
// y + y_dot + y_ddot / 2 (rates for a unit of time) and corrects by Newton-Raphson; it is taken if
// the correction is small and the new rates continue the old ones, so that the branch of the start
// is kept, and tried again at half the length otherwise. Steps shorten in proportion to the
// distance from where the transmission quality would be zero. Where they vanish the linkage is
// locked: the drives cannot go on. Where the quality passes through zero, other branches cross: the
// singular position is found as the minimum of the quality on the interpolated motion. From a lock
// the linkage is moved back along the curve of its closed poses, on the side from which it came.
#pragma once

#include <vector>

#include "core/kinematics/drive_path.h"
#include "core/kinematics/singular_position.h"

namespace linkstudy {

struct DrivenPose {
  double time = 0.0;      // of the course, s
  State<double> s;        // positions and velocities
  Eigen::VectorXd drive;  // (n) driven coordinates, rad or m
  std::vector<double> a;  // (nv) accelerations
  double quality = 0.0;   // transmission quality
  double residual = 0.0;  // norm of the scaled closure rows
  // Velocities and accelerations are not determined by the drives but continued from poses before.
  bool is_singular = false;
};

struct CourseOptions {
  int positions = 73;  // evenly spaced in time, both ends included; at least 2
  // Where the way to the end is locked, also go from the begin the other way until it is locked
  // there: back in time, on linear courses.
  bool both_ways = false;
};

// The lowest transmission quality on the way, between the positions as well.
struct Transmission {
  double quality = 1.0;
  double time = 0.0;
  Eigen::VectorXd drive;  // (n) rad or m
};

struct DriveCycle {
  std::vector<DrivenPose> poses;  // in the order of time, those that can be reached
  std::vector<SingularPosition> singular;
  Transmission worst;
  bool is_reached = false;  // the begin of the course: without it there are no poses
  bool is_complete = false;
};

// The drives first go straight from `start` to the begin of the path.
DriveCycle follow_drives(const DrivenLinkage& linkage, const State<double>& start,
                         const MobilityReport& mobility, const DrivePath& path,
                         const CourseOptions& options);

}  // namespace linkstudy
