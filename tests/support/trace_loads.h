// Generalised forces of the loads of a linkage (descriptions in core/topology/linkage.h):
// a drive adds value * f to its coordinate, a resistance opposes its coordinate's speed, forces and
// torques on links act through the derivatives of the link's transform. N and N m.
#pragma once

#include "tests/support/trace_kinematics.h"

namespace linkstudy::testing {

double course_value(const Course& course, double t);
double resistance_value(const ResistanceLaw& law,
                        double speed);  // opposes motion: has speed's sign

Vector generalised_loads(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                         double t, const Vector& v);

// Springs and dampers of joints: -c (q - rest) - b v on their coordinates, and 1/2 c (q - rest)^2.
Vector joint_springs(const TraceModel& model, const Vector& q, const Vector& v);
double spring_energy(const TraceModel& model, const Vector& q);

// Direction of a link_force or link_torque in ground axes.
Eigen::Vector3d load_direction(const TraceLoad& load, const std::vector<LinkTransform>& transforms);

}  // namespace linkstudy::testing
