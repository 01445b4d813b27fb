// Swings and transmission angles (study/kinematics/swings.h) in words, as tables and as JSON,
// angles in degrees.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "study/kinematics/result.h"
#include "study/record/findings.h"
#include "study/record/table.h"

namespace linkstudy {

// Joints on ground that are not driven, and the least transmission angle of each loop.
std::vector<Finding> swing_findings(const KinematicsResult& result);

// A row a joint coordinate.
Table swings_table(const KinematicsResult& result);
// A row a position: time, the drives, the angle of each loop; no columns of loops where there are
// none.
Table transmission_table(const KinematicsResult& result);

nlohmann::ordered_json swings_json(const KinematicsResult& result);
nlohmann::ordered_json transmission_json(const KinematicsResult& result);

}  // namespace linkstudy
