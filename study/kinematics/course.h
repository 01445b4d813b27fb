// Which joints `kinematics` drives and how: --drive and its companions, else the table [kinematics]
// of the model, else the joint of the first drive load or of ground, once around.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/kinematics/drive_cycle.h"
#include "study/config/model_reader.h"

namespace linkstudy {

// What --drive and its companions say.
struct CourseRequest {
  std::vector<std::string> drives;  // joint.NAME or joint.NAME=FROM:TO
  std::optional<std::string> from;  // of the driven coordinate, with or without unit
  std::optional<std::string> to;
  std::optional<std::string> speed;
  std::optional<int> positions;
};

struct KinematicsCourse {
  std::vector<Drive> drives;
  DrivePath path;
  CourseOptions options;
};

// Nothing where no joint can be driven. Throws UsageError. `extent` of the mechanism in m.
std::optional<KinematicsCourse> choose_course(const CourseRequest& request,
                                              const KinematicsOptions& declared, const Mechanism& m,
                                              const State<double>& start, double extent);

}  // namespace linkstudy
