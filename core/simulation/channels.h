// Channels: every scalar of a run that has a name (interface: "joint.A.q", "closure.S.force.x",
// "energy.residual", ...). Units SI. Names, units, frames, points and signs: channel_kinds.cpp.
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
  motion_effort,
  motion_power,
  coupling_effort,
  stop_force,
  spring_length,
  spring_rate,
  spring_force,
  point_position,
  point_velocity,
  point_acceleration,
  kinetic,
  potential,
  supplied,
  dissipated,
  residual,
  dissipated_in_contacts
};

struct Channel {
  std::string name;
  std::string unit;
  Quantity quantity;
  // coordinate, body, closure, clearance, contact, bristle, friction, motion, coupling, spring,
  // point
  int index = 0;
  int component = 0;             // 0 1 2 for x y z
  BodyIndex body = kGroundBody;  // that carries a point
};

// Whether a velocity is that of a turn.
bool is_rotation(const Mechanism& mechanism, VelocityIndex v);

// All channels of a mechanism in a fixed order, time first.
std::vector<Channel> list_channels(const Mechanism& mechanism);

// Channels that a signal names: one channel, or a group such as "closure.S.force" (x y z).
// Empty if there is none.
std::vector<Channel> find_channels(const std::vector<Channel>& all, const std::string& signal);

// Names a signal may have: every channel or its group.
std::vector<std::string> signal_names(const std::vector<Channel>& all);

}  // namespace linkstudy
