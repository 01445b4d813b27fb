#include "core/simulation/channel_kinds.h"

#include <algorithm>
#include <array>

#include "core/model/walk.h"

namespace linkstudy {
namespace {

constexpr std::string_view kRubbing = "joints with friction";
constexpr std::string_view kStopped = "joints with end stops";
constexpr std::string_view kLoose = "closures with clearance";
constexpr std::string_view kLooseRubbing = "closures with clearance and friction";
constexpr std::string_view kVector = "x|y|z";

constexpr std::array kKinds = {
    ChannelKind{Quantity::time, "", "time", "", "s", "", "time"},
    ChannelKind{Quantity::q, "joint", "q", "[i]", "rad|m|1", "",
                "coordinate i, in the order of the joint's type"},
    ChannelKind{Quantity::v, "joint", "v", "[i]", "rad/s|m/s", "",
                "rate of coordinate i; with coordinates = \"quaternion\" the angular velocity of "
                "the child in the parent, in the axes of the child's joint frame (body frame)"},
    ChannelKind{Quantity::a, "joint", "a", "[i]", "rad/s^2|m/s^2", "", "rate of v"},
    ChannelKind{Quantity::joint_force, "joint", "force", kVector, "N", "",
                "reaction: force of the parent on the child link at the joint's origin in the "
                "child, ground axes; all that passes through the joint, along its free directions "
                "too: loads, springs and friction of the joint"},
    ChannelKind{Quantity::joint_torque, "joint", "torque", kVector, "N m", "",
                "reaction: moment of the parent on the child link about the joint's origin in the "
                "child, ground axes; about the joint's axis it holds the drive, resistance, "
                "spring and friction of the joint"},
    ChannelKind{Quantity::joint_force_local, "joint", "force_local", kVector, "N", "",
                "the reaction force in the axes of the joint frame of the child (a tree joint "
                "moves along or about z)"},
    ChannelKind{Quantity::joint_torque_local, "joint", "torque_local", kVector, "N m", "",
                "the reaction moment in the axes of the joint frame of the child: z holds what "
                "acts about the axis of a revolute joint"},
    ChannelKind{Quantity::closure_force, "closure", "force", kVector, "N", "",
                "force on chain 1 (the link of `first`) at the closure point, its opposite on "
                "chain 2, ground axes"},
    ChannelKind{Quantity::closure_torque, "closure", "torque", kVector, "N m", "",
                "moment on chain 1 (the link of `first`) about the closure point, its opposite on "
                "chain 2, ground axes"},
    ChannelKind{Quantity::closure_gap, "closure", "gap", kVector, "m", "",
                "point of `second` less point of `first`, ground axes"},
    ChannelKind{Quantity::eccentricity, "closure", "eccentricity", "x|y", "m", kLoose,
                "bearing centre less journal centre in the middle of the bearing, across its axis: "
                "x along the y axis and y along the z axis of the bearing's frame (its x is the "
                "axis of the joint)"},
    ChannelKind{Quantity::penetration, "closure", "penetration", "i", "m", kLoose,
                "depth of contact i, not below zero; planar has contact 0, spatial 0 and 1 at the "
                "ends of the bearing, -x and +x"},
    ChannelKind{Quantity::normal_force, "closure", "normal_force", "i", "N", kLoose,
                "normal force of contact i, not below zero"},
    ChannelKind{Quantity::friction_force, "closure", "friction_force", "i", "N", kLooseRubbing,
                "friction of contact i, positive against the journal's turn in the bearing"},
    ChannelKind{Quantity::bristle, "", "bristle", "[i]", "m", "",
                "deflection of the bristle of the friction law"},
    ChannelKind{Quantity::contact_state, "closure", "contact_state", "", "", kLoose,
                "0 free, 1 one point, 2 two points on opposite sides, 3 along a line"},
    ChannelKind{Quantity::friction_load, "joint", "normal_load", "", "N", kRubbing,
                "normal load that makes the friction, preload included"},
    ChannelKind{Quantity::joint_friction, "joint", "friction", "[i]", "N m|N", kRubbing,
                "friction, positive against the rate of the coordinate; of a cylindrical joint 0 "
                "against its turn, 1 against its shift; of a ball under a constant load about x, "
                "y, z of its child frame"},
    ChannelKind{Quantity::motion_effort, "motion", "effort", "", "N m|N", "",
                "what the prescribed motion takes: generalised force along the coordinate, of the "
                "parent on the child; beside springs, friction and loads of the joint"},
    ChannelKind{Quantity::motion_power, "motion", "power", "", "W", "",
                "effort times the rate of the coordinate: what the drive puts into the linkage"},
    ChannelKind{Quantity::coupling_effort, "coupling", "effort", "", "N m|N", "",
                "times the factor of a term: the generalised force that the coupling puts on its "
                "coordinate; the teeth of a gear pair press with effort / radius"},
    ChannelKind{Quantity::stop_force, "joint", "stop.force", "[i]", "N m|N", kStopped,
                "force or moment of the end stops on coordinate i, positive where it pushes the "
                "coordinate up"},
    ChannelKind{Quantity::spring_length, "spring", "length", "", "m", "",
                "distance of the two points"},
    ChannelKind{Quantity::spring_rate, "spring", "rate", "", "m/s", "",
                "rate of the length, positive where the points move apart"},
    ChannelKind{Quantity::spring_force, "spring", "force", "", "N", "",
                "force of spring, damper and actuator along the line, positive where it pulls the "
                "points together"},
    ChannelKind{Quantity::point_position, "point", "position", kVector, "m", "",
                "position from the ground's origin, ground axes"},
    ChannelKind{Quantity::point_velocity, "point", "velocity", kVector, "m/s", "",
                "velocity in the ground, ground axes"},
    ChannelKind{Quantity::point_acceleration, "point", "acceleration", kVector, "m/s^2", "",
                "acceleration in the ground, without gravity, ground axes"},
    ChannelKind{Quantity::kinetic, "energy", "kinetic", "", "J", "", "kinetic energy"},
    ChannelKind{Quantity::potential, "energy", "potential", "", "J", "",
                "energy of gravity, springs and replacement joints"},
    ChannelKind{Quantity::supplied, "energy", "supplied", "", "J", "",
                "work of driving loads and prescribed motions since the start"},
    ChannelKind{Quantity::dissipated, "energy", "dissipated", "", "J", "",
                "work taken by dampers, resistances, friction and contacts since the start"},
    ChannelKind{Quantity::residual, "energy", "residual", "", "J", "",
                "kinetic + potential - supplied + dissipated, less its value at the start: the "
                "error of the integration"},
    ChannelKind{Quantity::dissipated_in_contacts, "energy", "dissipated_in_contacts", "", "J",
                "linkages with clearances or end stops",
                "what of energy.dissipated contacts take, their friction included"},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (kKinds[i].quantity != static_cast<Quantity>(i)) return false;
  }
  return kKinds.size() == static_cast<std::size_t>(Quantity::dissipated_in_contacts) + 1;
}
static_assert(in_order());

constexpr const char* kAxes[] = {"x", "y", "z"};

bool turns(BasicMotion motion) {
  return motion >= BasicMotion::rx;
}

// 0 1 2 for x y z; a screw has z.
int axis_of(BasicMotion motion) {
  if (motion == BasicMotion::screw) return 2;
  return (static_cast<int>(motion) - static_cast<int>(BasicMotion::tx)) % 3;
}

std::string ball_text(const Channel& channel, const Stage& stage) {
  constexpr const char* kParameters[] = {"w", "x", "y", "z"};
  if (channel.quantity == Quantity::q) {
    return std::string("Euler parameter ") + kParameters[channel.index - stage.q.value()] +
           " of the child's joint frame in the parent's";
  }
  return std::string(channel.quantity == Quantity::v ? "angular velocity"
                                                     : "angular acceleration") +
         " about " + kAxes[channel.index - stage.v.value()] +
         " of the child's joint frame (body frame)";
}

// An axis is new where an earlier turn of the joint, about another axis, carries it.
std::string motion_text(const Mechanism& m, StageIndex stage, StageIndex first) {
  const BasicMotion motion = m.stages[stage].motion;
  const int axis = axis_of(motion);
  bool is_new = false;
  for (const StageIndex i : indices(first, stage)) {
    const BasicMotion before = m.stages[i].motion;
    is_new = is_new || (turns(before) && axis_of(before) != axis);
  }
  std::string text = turns(motion) ? "turn of the child about " : "shift of the child along ";
  text += is_new ? "the new " : "";
  text += kAxes[axis];
  if (motion == BasicMotion::screw) text += ", along which it advances";
  return text + (is_new ? "" : " of the joint frame in the parent");
}

std::string coordinate_text(const Mechanism& m, const Channel& channel) {
  const bool of_position = channel.quantity == Quantity::q;
  for (const Body& body : m.bodies) {
    for (const StageIndex i : stages_of(body)) {
      const Stage& stage = m.stages[i];
      const bool ball = stage.motion == BasicMotion::ball;
      const int first = of_position ? stage.q.value() : stage.v.value();
      const int count = ball ? (of_position ? 4 : 3) : 1;
      if (channel.index < first || channel.index >= first + count) continue;
      if (ball) return ball_text(channel, stage);
      const char* prefix = of_position                       ? ""
                           : channel.quantity == Quantity::v ? "rate: "
                                                             : "acceleration: ";
      return prefix + motion_text(m, i, body.stage_begin);
    }
  }
  return std::string(kind_of(channel.quantity).meaning);
}

}  // namespace

std::span<const ChannelKind> channel_kinds() {
  return kKinds;
}

const ChannelKind& kind_of(Quantity quantity) {
  return kKinds[static_cast<std::size_t>(quantity)];
}

std::string pattern_of(const ChannelKind& kind) {
  std::string text;
  if (kind.quantity == Quantity::bristle) {
    text = "joint|closure.NAME.";
  } else if (kind.owner == "energy") {
    text = "energy.";
  } else if (!kind.owner.empty()) {
    text = std::string(kind.owner) + ".NAME.";
  }
  text += kind.label;
  if (kind.members.empty()) return text;
  const bool optional = kind.members.front() == '[';
  return text + (optional ? "[.i]" : "." + std::string(kind.members));
}

std::string describe_channel(const Mechanism& mechanism, const Channel& channel) {
  switch (channel.quantity) {
    case Quantity::q:
    case Quantity::v:
    case Quantity::a:
      return coordinate_text(mechanism, channel);
    default:
      return std::string(kind_of(channel.quantity).meaning);
  }
}

bool is_in_group(const std::string& channel, const std::string& group) {
  return channel == group || channel.starts_with(group + ".");
}

std::vector<Channel> find_channel_group(const std::vector<Channel>& all, const std::string& group) {
  std::vector<Channel> found = find_channels(all, group);
  if (!found.empty() || group.empty()) return found;
  for (const Channel& c : all)
    if (is_in_group(c.name, group)) found.push_back(c);
  return found;
}

}  // namespace linkstudy
