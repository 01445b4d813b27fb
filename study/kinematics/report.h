// What the kinematics of a model look like to people and to programs.
#pragma once

#include <string>

#include "study/kinematics/result.h"

namespace linkstudy {

// Counts, mobility, redundant joints, idle freedoms, loops, course and singular positions, with a
// verdict.
std::string kinematics_text(const std::string& file, const std::string& name,
                            const KinematicsResult& result);

// The object of `kinematics --json`.
std::string kinematics_json(const KinematicsResult& result);

// "closure.S", "a12 a13 a23 a14 a24 a34"
std::string cut_of(const BasicLoop& loop);
std::string elements_text(const ProperElements& proper);

}  // namespace linkstudy
