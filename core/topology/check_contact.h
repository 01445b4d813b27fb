// Checks of friction, of end stops and of clearance: values in the range in which their laws hold.
// Part of check_joint and check_closure. Keys are those of the input: `clearance`, `contact`,
// `friction` of a closure, `friction` and `stop` of a joint.
#pragma once

#include "core/topology/record_check.h"

namespace linkstudy {

// LuGre: mu_s >= mu_k > 0, v_s > 0, sigma0 > 0, the rest not negative.
void check_friction(const Friction& friction, RecordCheck& record);

// Of a revolute, prismatic or cylindrical joint; a surface that turns has a radius.
void check_joint_friction(const Joint& joint, RecordCheck& record);

// Of a joint that has stops. On coordinates that are no quaternion; low below high.
void check_stops(const Joint& joint, RecordCheck& record);

// Of a closure of model clearance. Revolute only. The bearing has a radius, larger
// than the clearance, wherever friction or stiffness asks for it; stiffness from materials asks for
// a clearance above zero too, a spatial contact for the length of the bearing.
void check_clearance(const Closure& closure, RecordCheck& record);

}  // namespace linkstudy
