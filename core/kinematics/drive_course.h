// How driven joint coordinates are to move over the time of a course: the [kinematics] table of a
// model. With s = t / duration from 0 to 1 a drive goes from `from` to `to` by
//   linear          s
//   smooth          3 s^2 - 2 s^3                  at rest at both ends
//   polynomial_345  10 s^3 - 15 s^4 + 6 s^5        at rest, without acceleration at both ends
//   table           the natural cubic spline through (times, positions): no jump of acceleration,
//                   which is zero at both ends; it may swing beyond points that are far apart
// Units: s, rad or m.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/topology/linkage.h"

namespace linkstudy {

struct DriveCourse {
  std::string joint;
  int coordinate = 0;          // within the joint
  std::optional<double> from;  // empty: where the linkage stands
  // Empty: of a single drive a full turn, or a tenth of the linkage's extent; one of several rests.
  std::optional<double> to;
  MotionLaw law = MotionLaw::linear;
  std::vector<double> times;      // table: rising, the first is 0
  std::vector<double> positions;  // table: as many
  // A motion of the model, which has a time of its own; `from` is where the linkage stands.
  std::optional<Motion> motion;

  bool has_own_time() const { return motion || law == MotionLaw::table; }

  bool operator==(const DriveCourse&) const = default;
};

struct KinematicsOptions {
  std::vector<DriveCourse> drives;
  // Empty: the last time of a table; else what the longest way takes at 1 rad/s, or at 1 m/s where
  // no drive turns.
  std::optional<double> duration;
  int positions = 73;  // evenly spaced in time, both ends included

  bool operator==(const KinematicsOptions&) const = default;
};

}  // namespace linkstudy
