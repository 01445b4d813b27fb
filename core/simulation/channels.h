// Channels: every scalar of a run that has a name (interface: "joint.A.q", "closure.S.force.x",
// "energy.residual", ...). Units SI. Frames, signs and points:
//   joint.N.q|v|a[.i]            coordinates in the order of the joint, their rates; for a joint
//                                with a quaternion v and a are angular velocity and acceleration
//   joint.N.force|torque.x|y|z   reaction on the child link at the joint origin, ground axes
//   joint.N.force_local|...      the same in the child's joint frame
//   closure.N.force|torque.x..   on chain 1 (`first`) at the closure point, ground axes
//   closure.N.gap.x|y|z          second minus first closure point, ground axes
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
  int index = 0;      // coordinate, body or closure
  int component = 0;  // 0 1 2 for x y z
};

// All channels of a mechanism in a fixed order, time first.
std::vector<Channel> list_channels(const Mechanism& mechanism);

// Channels that a signal names: one channel, or a group such as "closure.S.force" (x y z).
// Empty if there is none.
std::vector<Channel> find_channels(const std::vector<Channel>& all, const std::string& signal);

// Names a signal may have: every channel or its group.
std::vector<std::string> signal_names(const std::vector<Channel>& all);

}  // namespace linkstudy
