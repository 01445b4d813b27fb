// What every kind of channel is called, its unit, and its meaning: frame, point, sign. The one
// statement of each; channels.cpp makes the channels of a mechanism from these rows.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulation/channels.h"

namespace linkstudy {

struct ChannelKind {
  Quantity quantity;
  std::string_view owner;    // "joint", "closure", "spring", "point", "energy"; empty for the time
  std::string_view label;    // last part of the name: "force"
  std::string_view members;  // "x|y|z", "x|y", "i", "[i]" (where there are several), or empty
  std::string_view unit;     // "rad|m" where the coordinate decides; empty for pure numbers
  std::string_view of;       // which owners have it; empty: all
  std::string_view meaning;
};

// In the order of `Quantity`.
std::span<const ChannelKind> channel_kinds();
const ChannelKind& kind_of(Quantity quantity);

// "joint.NAME.force.x|y|z"
std::string pattern_of(const ChannelKind& kind);

// What one channel of a mechanism is; of a coordinate also how it moves the child:
// "turn about the new y".
std::string describe_channel(const Mechanism& mechanism, const Channel& channel);

// Whether a channel is `group` itself or under that name: "closure.S.force.x" in "closure.S".
bool is_in_group(const std::string& channel, const std::string& group);

// The channels that find_channels gives, or else everything under a name: "joint.A", "closure.S",
// "spring.C", "point.tip", "energy".
std::vector<Channel> find_channel_group(const std::vector<Channel>& all, const std::string& group);

}  // namespace linkstudy
