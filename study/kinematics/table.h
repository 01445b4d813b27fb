// Tables of a driven course.
#pragma once

#include "study/kinematics/result.h"
#include "study/record/table.h"

namespace linkstudy {

// One row a position: time, joint.NAME.q|v|a of all tree joints, closure.NAME.q|v|a of the joints
// that close loops (core/kinematics/cut_joint.h), point.NAME.position|velocity|acceleration.x|y|z,
// quality, residual, mobility (nv - rank J there), closure.NAME.conditioning of the loops cut there
// (core/kinematics/loop_equations.h). Velocities and accelerations are missing at singular
// positions, where the drives do not determine them.
Table kinematics_table(const Model& closed, const KinematicsResult& result);

// One row a position: time, link.NAME.e.w|x|y|z (Euler parameters of the link in ground, of one
// sign along the course) and link.NAME.position.x|y|z of the link frame.
Table pose_table(const Linkage& linkage, const Model& closed, const KinematicsResult& result);

}  // namespace linkstudy
