// Transforms of the links with their first and second derivatives by the joint coordinates, as
// products of basic motions and derivative operators ([Palcak] eqs. 4.76-4.81):
//   T(p) = T(p-1) T~(p),  T_i = dT/dq_i,  T_ij = d2T/(dq_i dq_j)
// T_i and T_ij are stored by position in TraceLink::path; all others are zero.
#pragma once

#include "tests/support/trace_model.h"

namespace linkstudy::testing {

struct LinkTransform {
  Transform T;                               // link -> ground, (4 x 4)
  std::vector<Transform> T_i;                // (path)
  std::vector<std::vector<Transform>> T_ij;  // (path x path)
};

std::vector<LinkTransform> link_transforms(const TraceModel& model, const Vector& q);

// A frame or a point carried by a link: value, derivative by every coordinate, time derivative and
// the part of the second time derivative without accelerations, sum_ij X_ij v_i v_j.
struct CarriedFrame {
  Transform T;                 // (4 x 4)
  std::vector<Transform> T_i;  // (dof)
  Transform T_dot;
  Transform T_vv;
};
CarriedFrame carried_frame(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                           int link, const Transform& frame, const Vector& v);

Eigen::Vector3d point_position(const TraceModel& model,
                               const std::vector<LinkTransform>& transforms, int link,
                               const Eigen::Vector3d& point);

// Jacobian of a point of a link (velocity) and of the link's angular velocity, ground axes, (3 x
// dof).
Matrix point_jacobian(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                      int link, const Eigen::Vector3d& point);
Matrix rotation_jacobian(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                         int link);

}  // namespace linkstudy::testing
