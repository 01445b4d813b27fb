// What the kinematics of a model look like to people and to programs.
#pragma once

#include <string>

#include "study/kinematics/result.h"
#include "study/record/findings.h"

namespace linkstudy {

// Verdict, mobility, redundant joints, idle freedoms, course and singular positions, counts, loops.
std::vector<Finding> kinematics_findings(const KinematicsResult& result);

// The same below the model, as aligned lines.
std::string kinematics_text(const std::string& file, const std::string& name,
                            const KinematicsResult& result);

// The object of `kinematics --json`.
std::string kinematics_json(const KinematicsResult& result);

// "closure.S", "a12 a13 a23 a14 a24 a34"
std::string cut_of(const BasicLoop& loop);
std::string elements_text(const ProperElements& proper);

}  // namespace linkstudy
