// Which joints `kinematics` drives and how: --drive and its companions, else the table [kinematics]
// of the model, else the joint of the first drive load or of ground, once around.
#pragma once

#include <optional>
#include <vector>

#include "core/kinematics/drive_cycle.h"
#include "study/cli/command_line.h"

namespace linkstudy {

struct KinematicsCourse {
  std::vector<Drive> drives;
  DrivePath path;
  CourseOptions options;
};

// Nothing where no joint can be driven. Throws UsageError. `extent` of the mechanism in m.
std::optional<KinematicsCourse> choose_course(const CommandLine& line,
                                              const KinematicsOptions& declared, const Mechanism& m,
                                              const State<double>& start, double extent);

}  // namespace linkstudy
