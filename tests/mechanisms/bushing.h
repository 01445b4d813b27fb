// A body on an elastic bushing at its centre of mass: a ball joint (quaternion) with a sde of three
// rotational stiffnesses towards ground, closure frames and axes of inertia along the ground's.
// With tilt = angle the potential is 1/2 sum k_i phi_i^2: about one axis alone, or with equal
// stiffnesses and moments of inertia, the turn swings with sqrt(k / I) at any amplitude short of
// half a turn. With tilt = axis the moment about one axis alone is (k / 2) sin 2 phi.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct Bushing {
  TiltMeasure tilt = TiltMeasure::angle;
  Eigen::Vector3d stiffness{5.0, 5.0, 5.0};           // N m/rad
  Eigen::Vector3d damping = Eigen::Vector3d::Zero();  // N m s/rad
  Eigen::Vector3d inertia{0.1, 0.12, 0.15};           // kg m^2
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();     // rotation vector at the start, rad
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();     // angular velocity in the body's axes, rad/s
};

// Joint S, closure B (ground first), no gravity; it begins as given.
Linkage bushing(const Bushing& data = {});

// The same with a constant torque on the body, ground axes, N m.
Linkage bushing_under(const Eigen::Vector3d& torque, const Bushing& data = {});

}  // namespace linkstudy::testing
