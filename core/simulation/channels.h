// Channels: every scalar of a run that has a name (interface: "joint.A.q", "closure.S.force.x",
// "energy.residual", ...). Units SI. Frames, signs and points:
//   joint.N.q|v|a[.i]            coordinates in the order of the joint, their rates; for a joint
//                                with a quaternion v and a are angular velocity and acceleration
//   joint.N.force|torque.x|y|z   reaction on the child link at the joint origin, ground axes
//   joint.N.force_local|...      the same in the child's joint frame
//   closure.N.force|torque.x..   on chain 1 (`first`) at the closure point, ground axes
//   closure.N.gap.x|y|z          second minus first closure point, ground axes
//   joint.N.normal_load          of a joint with friction; joint.N.friction[.i]: against the motion
//                                of its coordinates; joint.N.bristle[.i]
//   with clearance:
//   closure.N.eccentricity.x|y   bearing centre less journal centre along y and z of the bearing's
//                                frame (x is its axis), in the middle of the bearing
//   closure.N.penetration.i, .normal_force.i, .friction_force.i, .bristle.i
//                                of contact i: planar 0; spatial 0 and 1, at the ends of the
//                                bearing
//                                (-x and +x); friction against the journal's turn in the bearing
//   closure.N.contact_state      0 free, 1 one point, 2 two points on opposite sides, 3 line
//   point.N.position|velocity|acceleration.x|y|z
//                                of a chosen point, ground axes
//   energy.kinetic|potential|supplied|dissipated|residual
#pragma once

#include <string>
#include <vector>

#include "core/model/mechanism.h"

namespace linkstudy {

enum class Quantity : std::uint8_t {
  time,
  q,
  v,
  a,
  joint_force,
  joint_torque,
  joint_force_local,
  joint_torque_local,
  closure_force,
  closure_torque,
  closure_gap,
  eccentricity,
  penetration,
  normal_force,
  friction_force,
  bristle,
  contact_state,
  friction_load,
  joint_friction,
  point_position,
  point_velocity,
  point_acceleration,
  kinetic,
  potential,
  supplied,
  dissipated,
  residual
};

struct Channel {
  std::string name;
  std::string unit;
  Quantity quantity;
  int index = 0;      // coordinate, body, closure, clearance, contact, bristle, friction or point
  int component = 0;  // 0 1 2 for x y z
  int body = 0;       // that carries a point
};

// All channels of a mechanism in a fixed order, time first.
std::vector<Channel> list_channels(const Mechanism& mechanism);

// Channels that a signal names: one channel, or a group such as "closure.S.force" (x y z).
// Empty if there is none.
std::vector<Channel> find_channels(const std::vector<Channel>& all, const std::string& signal);

// Names a signal may have: every channel or its group.
std::vector<std::string> signal_names(const std::vector<Channel>& all);

}  // namespace linkstudy
