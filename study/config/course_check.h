// What the table [kinematics] says with more than one key: joint and coordinate exist and can be
// driven, each by one drive; ends differ; tables fit each other and the duration.
#pragma once

#include "core/kinematics/drive_course.h"
#include "study/config/key.h"

namespace linkstudy {

void check_drive(DriveCourse& drive, Tree& table, const Reading& reading);
void check_course(KinematicsOptions& options, Tree& table, const Reading& reading);

}  // namespace linkstudy
