// Positions of driven coordinates over the time of a course, with both derivatives: the laws of
// drive_course.h, the spline of a table, motions of the model. A linear course goes on beyond both
// of its ends, every other one of [kinematics] rests there.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/kinematics/drive_course.h"
#include "core/topology/motion_numbers.h"

namespace linkstudy {

// (n) each, one entry a drive: rad or m, per s, per s^2.
struct DriveMotion {
  Eigen::VectorXd position;
  Eigen::VectorXd rate;
  Eigen::VectorXd second_rate;
};

class DrivePath {
 public:
  // `from` and `to` of every course are given (a table needs neither), duration > 0.
  DrivePath(std::vector<DriveCourse> courses, double duration);

  // All drives straight from one position to another in one second.
  static DrivePath straight(const Eigen::VectorXd& from, const Eigen::VectorXd& to);

  double duration() const { return duration_; }
  // Over a longer time a course could turn and come back unseen; infinite where all are linear.
  double longest_step() const;
  const std::vector<DriveCourse>& courses() const { return courses_; }

  Eigen::VectorXd position(double t) const { return at(t).position; }
  DriveMotion at(double t) const;

 private:
  std::vector<DriveCourse> courses_;
  double duration_;
  std::vector<MotionNumbers> laws_;
};

}  // namespace linkstudy
