// Checks that need one record only: numbers finite and in range, inertia of a body, proper
// rotations, counts of coordinates, springs, friction, clearance, flexible beams, courses and laws.
// Part of check(Linkage).
#pragma once

#include <string>
#include <vector>

#include "core/topology/linkage.h"
#include "core/topology/problem.h"

namespace linkstudy {

// Principal moments of a body: positive, and none larger than the sum of the other two (to 1e-3 of
// the largest: tables round to three digits). Empty when it is so, else what is wrong.
std::string inertia_fault(const Eigen::Matrix3d& inertia);

// Empty for a matrix orthonormal to 1e-6 with determinant +1, else what is wrong.
std::string rotation_fault(const Eigen::Matrix3d& rotation);

// Each appends to `problems`; `path` addresses the record, such as "joint.A".
void check_link(const Link& link, const std::string& path, std::vector<Problem>& problems);
void check_joint(const Joint& joint, const std::string& path, std::vector<Problem>& problems);
void check_closure(const Closure& closure, const std::string& path, std::vector<Problem>& problems);
void check_load(const Load& load, const std::string& path, std::vector<Problem>& problems);
void check_point(const ChosenPoint& point, const std::string& path, std::vector<Problem>& problems);

}  // namespace linkstudy
