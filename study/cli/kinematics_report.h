// What the kinematics of a model look like to people and to programs.
#pragma once

#include <optional>
#include <string>

#include "core/kinematics/drive_cycle.h"
#include "study/report/table.h"

namespace linkstudy {

struct KinematicsResult {
  AssemblyReport assembly;
  MobilityReport mobility;
  std::optional<DrivenLinkage> driven;  // nothing where there is nothing to drive
  CourseOptions course;
  double speed = 1.0;  // of the drive, rad/s or m/s
  DriveCycle cycle;
};

// Counts, mobility, redundant joints, idle freedoms, course and singular positions, with a verdict.
std::string kinematics_text(const std::string& file, const std::string& name,
                            const KinematicsResult& result);

// The object of `kinematics --json`.
std::string kinematics_json(const KinematicsResult& result);

// One row a position: joint.NAME.q|v|a of all joints, quality, residual. Velocities and
// accelerations are missing at singular positions, where the drive does not determine them.
Table kinematics_table(const Mechanism& mechanism, const KinematicsResult& result);

}  // namespace linkstudy
