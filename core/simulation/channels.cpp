#include "core/simulation/channels.h"

#include <algorithm>

#include "core/simulation/channel_kinds.h"

namespace linkstudy {

bool is_rotation(const Mechanism& m, int v) {
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
    for (std::size_t b = 1; b < m_.bodies.size(); ++b) add_joint(static_cast<int>(b));
    for (std::size_t i = 0; i < m_.closures.size(); ++i) {
      const std::string name = "closure." + m_.closure_names[i];
      const int closure = static_cast<int>(i);
      add_vector(name, Quantity::closure_force, closure);
      add_vector(name, Quantity::closure_torque, closure);
      add_vector(name, Quantity::closure_gap, closure);
      add_clearances_of(closure, name);
    }
    for (std::size_t i = 0; i < m_.motions.size(); ++i) add_motion(i);
    for (std::size_t i = 0; i < m_.couplings.size(); ++i) add_coupling(i);
    for (std::size_t i = 0; i < m_.spring_names.size(); ++i) add_spring(i);
    for (std::size_t i = 0; i < m_.point_bodies.size(); ++i) add_point(i);
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

  void add_motion(std::size_t i) {
    const std::string name = "motion." + m_.motion_names[i];
    const int index = static_cast<int>(i);
    const bool turns = is_rotation(m_, m_.motions[i].v);
    add(name, Quantity::motion_effort, index, {.unit = turns ? "N m" : "N"});
    add(name, Quantity::motion_power, index);
  }

  void add_coupling(std::size_t i) {
    const RowKind kind = m_.cut_rows[static_cast<std::size_t>(m_.couplings[i].row)].kind;
    add("coupling." + m_.coupling_names[i], Quantity::coupling_effort, static_cast<int>(i),
        {.unit = kind == RowKind::coupling_turn ? "N m" : "N"});
  }

  void add_spring(std::size_t i) {
    const std::string name = "spring." + m_.spring_names[i];
    for (const ChannelKind& kind : channel_kinds()) {
      if (kind.owner == "spring") add(name, kind.quantity, static_cast<int>(i));
    }
  }

  void add_point(std::size_t i) {
    const std::string name = "point." + m_.point_names[i];
    const auto first = static_cast<std::ptrdiff_t>(channels_.size());
    const int index = static_cast<int>(i);
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

  void add_joint(int b) {
    const Body& body = m_.bodies[static_cast<std::size_t>(b)];
    const std::string name = "joint." + m_.joint_names[static_cast<std::size_t>(b)];
    for (int i = 0; i < body.q_count; ++i) {
      const bool pure_number = body.q_count != body.v_count && i >= body.q_count - 4;
      const char* unit = pure_number ? "" : is_rotation(m_, body.v_begin + i) ? "rad" : "m";
      add_coordinate(name, Quantity::q, body.q_begin, i, body.q_count, unit);
    }
    for (int i = 0; i < body.v_count; ++i) {
      const bool rotation = is_rotation(m_, body.v_begin + i);
      add_coordinate(name, Quantity::v, body.v_begin, i, body.v_count, rotation ? "rad/s" : "m/s");
    }
    for (int i = 0; i < body.v_count; ++i) {
      const bool rotation = is_rotation(m_, body.v_begin + i);
      add_coordinate(name, Quantity::a, body.v_begin, i, body.v_count,
                     rotation ? "rad/s^2" : "m/s^2");
    }
    add_vector(name, Quantity::joint_force, b);
    add_vector(name, Quantity::joint_torque, b);
    add_vector(name, Quantity::joint_force_local, b);
    add_vector(name, Quantity::joint_torque_local, b);
    add_stops_of(body, name);
    add_friction_of(b, name);
    add_constant_friction_of(b, name);
  }

  void add_stops_of(const Body& body, const std::string& name) {
    for (int i = 0; i < body.v_count; ++i) {
      const int v = body.v_begin + i;
      const auto is_own = [v](const StopStructure& stop) { return stop.v == v; };
      if (std::ranges::none_of(m_.stops, is_own)) continue;
      add_coordinate(name, Quantity::stop_force, body.v_begin, i, body.v_count,
                     is_rotation(m_, v) ? "N m" : "N");
    }
  }

  void add_clearances_of(int closure, const std::string& name) {
    for (std::size_t i = 0; i < m_.clearances.size(); ++i) {
      const ClearanceStructure& c = m_.clearances[i];
      if (c.closure != closure) continue;
      add_vector(name, Quantity::eccentricity, static_cast<int>(i), 2);
      add_contacts(c, name, Quantity::penetration);
      add_contacts(c, name, Quantity::normal_force);
      add_contacts(c, name, Quantity::friction_force);
      add_contacts(c, name, Quantity::bristle);
      add(name, Quantity::contact_state, static_cast<int>(i));
    }
  }

  // Bristles are found by their own number; contacts without friction have none.
  void add_contacts(const ClearanceStructure& c, const std::string& name, Quantity quantity) {
    for (int i = c.contact_begin; i < c.contact_end; ++i) {
      const int z = m_.contacts[static_cast<std::size_t>(i)].z;
      const bool rubs = quantity == Quantity::friction_force || quantity == Quantity::bristle;
      if (rubs && z < 0) continue;
      add(name, quantity, quantity == Quantity::bristle ? z : i,
          {.suffix = "." + std::to_string(i - c.contact_begin)});
    }
  }

  void add_friction_of(int b, const std::string& name) {
    for (std::size_t i = 0; i < m_.frictions.size(); ++i) {
      const JointFrictionStructure& f = m_.frictions[i];
      if (f.body != b) continue;
      const int index = static_cast<int>(i);
      const bool both = f.turn >= 0 && f.slide >= 0;
      const char* first = both ? ".0" : "";
      const char* second = both ? ".1" : "";
      add(name, Quantity::friction_load, index);
      if (f.turn >= 0) {
        add(name, Quantity::joint_friction, index, {.suffix = first, .unit = "N m"});
      }
      if (f.slide >= 0) {
        add(name, Quantity::joint_friction, index, {.suffix = second, .component = 1, .unit = "N"});
      }
      add(name, Quantity::bristle, f.z, {.suffix = first});
      if (both) add(name, Quantity::bristle, f.z + 1, {.suffix = second});
    }
  }

  // Numbered through where a joint has several: forces, then bristles.
  void add_constant_friction_of(int b, const std::string& name) {
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
            add(name, Quantity::bristle, f->z + k, {.suffix = suffix});
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
