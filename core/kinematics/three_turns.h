// Joints with three turns (spherical, free), whatever their coordinates: angular velocity in place
// of rates of angles, and the angles at which these say nothing.
//
// With the axes a_0 a_1 a_2 of the three angles, omega = A (rates), A = [a_0 a_1 a_2]. det A =
// -cos(theta) for z-y-x angles: at theta = +-90 deg two axes coincide, rates of angles grow without
// bound there and the linkage seems singular although it is not.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/model/compile.h"

namespace linkstudy {

// |det A| below which the angles of a joint count as singular: within 1.1 deg of 90 deg.
inline constexpr double kSingularAngles = 0.02;

// Columns of J (rows, nv), those of such joints by angular velocities in the child frame, as
// quaternion joints have them: the same for angles and quaternions at one pose. Joints that have
// not all three turns among the columns, or angles singular to rounding, stay as they are.
Eigen::MatrixXd take_columns_by_turns(const Model& model, const State<double>& s,
                                      const Eigen::MatrixXd& jacobian,
                                      const std::vector<int>& columns);

// "joint.S.1 = 89.97 deg" of joints whose angles are singular within `least` of |det A|.
std::vector<std::string> singular_angles(const Mechanism& m, Positions<const double> q,
                                         double least = kSingularAngles);

// The same for a run that was lost with the last state (q, v): near enough for rates to grow, 6
// deg, or already past it, where those of the first and the last angle are large and cancel each
// other.
std::vector<std::string> lost_angles(const Mechanism& m, Positions<const double> q,
                                     Velocities<const double> v);

// What to do about them: a sentence, or nothing where there are none.
std::string singular_angles_text(const std::vector<std::string>& angles);

}  // namespace linkstudy
