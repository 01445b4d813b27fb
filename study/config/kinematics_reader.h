// The course of a model's drives: the table [kinematics]. Judges what needs more than one key:
// joint and coordinate exist and can be driven, each by one drive; ends and tables in the unit of
// the coordinate; tables that fit each other and the duration.
#pragma once

#include "core/kinematics/drive_course.h"
#include "study/config/tree.h"

namespace linkstudy {

// `model` comes from validate().
KinematicsOptions read_kinematics(Tree& model, Diagnostics& diagnostics);

}  // namespace linkstudy
