#include "core/simulation/channels.h"

#include <algorithm>

#include "core/model/walk.h"
#include "core/simulation/channel_kinds.h"

namespace linkstudy {

bool is_rotation(const Mechanism& m, VelocityIndex v) {
  for (const Stage& s : m.stages) {
    if (s.motion == BasicMotion::ball && v >= s.v && v < s.v + 3) return true;
    if (s.v == v) return s.motion >= BasicMotion::rx;
  }
  return false;
}

namespace {

class Lister {
 public:
  explicit Lister(const Mechanism& m) : m_(m) {}

  std::vector<Channel> run() {
    add("", Quantity::time, 0);
    for (const BodyIndex b : bodies_outwards(m_)) add_joint(b);
    for (const ClosureIndex i : indices_of(m_.closures)) {
      const std::string name = "closure." + m_.closure_names[i];
      add_vector(name, Quantity::closure_force, i.value());
      add_vector(name, Quantity::closure_torque, i.value());
      add_vector(name, Quantity::closure_gap, i.value());
      add_clearances_of(i, name);
    }
    for (const MotionIndex i : indices_of(m_.motions)) add_motion(i);
    for (const CouplingIndex i : indices_of(m_.couplings)) add_coupling(i);
    for (const PointSpringIndex i : indices_of(m_.spring_names)) add_spring(i);
    for (const PointIndex i : indices_of(m_.point_bodies)) add_point(i);
    for (const ChannelKind& kind : channel_kinds()) {
      const bool has_it = kind.quantity != Quantity::dissipated_in_contacts || !m_.contacts.empty();
      if (kind.owner == "energy" && has_it) add("energy", kind.quantity, 0);
    }
    return std::move(channels_);
  }

 private:
  struct Member {
    std::string suffix = {};  // ".x", ".0"
    int component = 0;
    std::string_view unit = {};  // where the kind leaves a choice
  };

  // owner: "joint.A"; empty for the time.
  void add(const std::string& owner, Quantity quantity, int index, const Member& member) {
    const ChannelKind& kind = kind_of(quantity);
    std::string name = owner.empty() ? owner : owner + ".";
    name += kind.label;
    const bool is_choice = kind.unit.find('|') != std::string_view::npos;
    channels_.push_back({name + member.suffix, std::string(is_choice ? member.unit : kind.unit),
                         quantity, index, member.component});
  }

  void add(const std::string& owner, Quantity quantity, int index) {
    add(owner, quantity, index, {});
  }

  void add_vector(const std::string& owner, Quantity quantity, int index, int size = 3) {
    constexpr const char* axes[] = {".x", ".y", ".z"};
    for (int i = 0; i < size; ++i) {
      add(owner, quantity, index, {.suffix = axes[i], .component = i});
    }
  }

  void add_motion(MotionIndex i) {
    const std::string name = "motion." + m_.motion_names[i];
    const int index = i.value();
    const bool turns = is_rotation(m_, m_.motions[i].v);
    add(name, Quantity::motion_effort, index, {.unit = turns ? "N m" : "N"});
    add(name, Quantity::motion_power, index);
  }

  void add_coupling(CouplingIndex i) {
    const RowKind kind = m_.cut_rows[m_.couplings[i].row].kind;
    add("coupling." + m_.coupling_names[i], Quantity::coupling_effort, i.value(),
        {.unit = kind == RowKind::coupling_turn ? "N m" : "N"});
  }

  void add_spring(PointSpringIndex i) {
    const std::string name = "spring." + m_.spring_names[i];
    for (const ChannelKind& kind : channel_kinds()) {
      if (kind.owner == "spring") add(name, kind.quantity, i.value());
    }
  }

  void add_point(PointIndex i) {
    const std::string name = "point." + m_.point_names[i];
    const auto first = static_cast<std::ptrdiff_t>(channels_.size());
    const int index = i.value();
    add_vector(name, Quantity::point_position, index);
    add_vector(name, Quantity::point_velocity, index);
    add_vector(name, Quantity::point_acceleration, index);
    for (auto c = channels_.begin() + first; c != channels_.end(); ++c)
      c->body = m_.point_bodies[i];
  }

  void add_coordinate(const std::string& owner, Quantity quantity, int begin, int i, int count,
                      std::string_view unit) {
    const std::string suffix = count == 1 ? std::string() : "." + std::to_string(i);
    add(owner, quantity, begin + i, {.suffix = suffix, .unit = unit});
  }

  void add_joint(BodyIndex b) {
    const Body& body = m_.bodies[b];
    const std::string name = "joint." + m_.joint_names[b];
    for (int i = 0; i < body.q_count; ++i) {
      const bool pure_number = body.q_count != body.v_count && i >= body.q_count - 4;
      const char* unit = pure_number ? "" : is_rotation(m_, body.v_begin + i) ? "rad" : "m";
      add_coordinate(name, Quantity::q, body.q_begin.value(), i, body.q_count, unit);
    }
    for (int i = 0; i < body.v_count; ++i) {
      const bool rotation = is_rotation(m_, body.v_begin + i);
      add_coordinate(name, Quantity::v, body.v_begin.value(), i, body.v_count,
                     rotation ? "rad/s" : "m/s");
    }
    for (int i = 0; i < body.v_count; ++i) {
      const bool rotation = is_rotation(m_, body.v_begin + i);
      add_coordinate(name, Quantity::a, body.v_begin.value(), i, body.v_count,
                     rotation ? "rad/s^2" : "m/s^2");
    }
    add_vector(name, Quantity::joint_force, b.value());
    add_vector(name, Quantity::joint_torque, b.value());
    add_vector(name, Quantity::joint_force_local, b.value());
    add_vector(name, Quantity::joint_torque_local, b.value());
    add_stops_of(body, name);
    add_friction_of(b, name);
    add_constant_friction_of(b, name);
  }

  void add_stops_of(const Body& body, const std::string& name) {
    for (int i = 0; i < body.v_count; ++i) {
      const VelocityIndex v = body.v_begin + i;
      const auto is_own = [v](const StopStructure& stop) { return stop.v == v; };
      if (std::ranges::none_of(m_.stops, is_own)) continue;
      add_coordinate(name, Quantity::stop_force, body.v_begin.value(), i, body.v_count,
                     is_rotation(m_, v) ? "N m" : "N");
    }
  }

  void add_clearances_of(ClosureIndex closure, const std::string& name) {
    for (const ClearanceIndex i : indices_of(m_.clearances)) {
      const ClearanceStructure& c = m_.clearances[i];
      if (c.closure != closure) continue;
      add_vector(name, Quantity::eccentricity, i.value(), 2);
      add_contacts(c, name, Quantity::penetration);
      add_contacts(c, name, Quantity::normal_force);
      add_contacts(c, name, Quantity::friction_force);
      add_contacts(c, name, Quantity::bristle);
      add(name, Quantity::contact_state, i.value());
    }
  }

  // Bristles are found by their own number; contacts without friction have none.
  void add_contacts(const ClearanceStructure& c, const std::string& name, Quantity quantity) {
    for (const ContactIndex i : contacts_of(c)) {
      const BristleIndex z = m_.contacts[i].z;
      const bool rubs = quantity == Quantity::friction_force || quantity == Quantity::bristle;
      if (rubs && !z.exists()) continue;
      add(name, quantity, quantity == Quantity::bristle ? z.value() : i.value(),
          {.suffix = "." + std::to_string(i - c.contact_begin)});
    }
  }

  void add_friction_of(BodyIndex b, const std::string& name) {
    for (const FrictionIndex i : indices_of(m_.frictions)) {
      const JointFrictionStructure& f = m_.frictions[i];
      if (f.body != b) continue;
      const int index = i.value();
      const bool both = f.turn.exists() && f.slide.exists();
      const char* first = both ? ".0" : "";
      const char* second = both ? ".1" : "";
      add(name, Quantity::friction_load, index);
      if (f.turn.exists()) {
        add(name, Quantity::joint_friction, index, {.suffix = first, .unit = "N m"});
      }
      if (f.slide.exists()) {
        add(name, Quantity::joint_friction, index, {.suffix = second, .component = 1, .unit = "N"});
      }
      add(name, Quantity::bristle, f.z.value(), {.suffix = first});
      if (both) add(name, Quantity::bristle, f.z.value() + 1, {.suffix = second});
    }
  }

  // Numbered through where a joint has several: forces, then bristles.
  void add_constant_friction_of(BodyIndex b, const std::string& name) {
    const auto& all = m_.constant_frictions;
    const auto is_own = [b](const ConstantFrictionStructure& f) { return f.body == b; };
    const auto own = std::find_if(all.begin(), all.end(), is_own);
    if (own == all.end()) return;
    const auto end = std::find_if_not(own, all.end(), is_own);
    const bool is_one = own + 1 == end && own->count == 1;
    for (const bool bends : {false, true}) {
      int number = 0;
      for (auto f = own; f != end; ++f) {
        const int index = m_.friction_count() + static_cast<int>(f - all.begin());
        for (int k = 0; k < f->count; ++k, ++number) {
          const std::string suffix = is_one ? "" : "." + std::to_string(number);
          const bool turns = f->turns && (f->count != 2 || k == 0);
          if (bends) {
            add(name, Quantity::bristle, f->z.value() + k, {.suffix = suffix});
          } else {
            add(name, Quantity::joint_friction, index,
                {.suffix = suffix, .component = k, .unit = turns ? "N m" : "N"});
          }
        }
      }
    }
  }

  const Mechanism& m_;
  std::vector<Channel> channels_;
};

std::string group_of(const std::string& name) {
  const auto dot = name.rfind('.');
  const std::string last = name.substr(dot + 1);
  const bool member = last == "x" || last == "y" || last == "z" ||
                      last.find_first_not_of("0123456789") == std::string::npos;
  return dot == std::string::npos || !member ? name : name.substr(0, dot);
}

}  // namespace

std::vector<Channel> list_channels(const Mechanism& mechanism) {
  return Lister(mechanism).run();
}

std::vector<Channel> find_channels(const std::vector<Channel>& all, const std::string& signal) {
  std::vector<Channel> found;
  for (const Channel& c : all) {
    if (c.name == signal || group_of(c.name) == signal) found.push_back(c);
  }
  return found;
}

std::vector<std::string> signal_names(const std::vector<Channel>& all) {
  std::vector<std::string> names;
  for (const Channel& c : all) {
    const std::string group = group_of(c.name);
    if (names.empty() || names.back() != group) names.push_back(group);
  }
  return names;
}

}  // namespace linkstudy
