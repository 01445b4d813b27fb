#include "core/simulation/channels.h"

#include <algorithm>

namespace linkstudy {
namespace {

bool is_rotation(const Mechanism& m, int v) {
  for (const Stage& s : m.stages) {
    if (s.motion == BasicMotion::ball && v >= s.v && v < s.v + 3) return true;
    if (s.v == v) return s.motion >= BasicMotion::rx;
  }
  return false;
}

class Lister {
 public:
  explicit Lister(const Mechanism& m) : m_(m) {}

  std::vector<Channel> run() {
    add("time", "s", Quantity::time, 0, 0);
    for (std::size_t b = 1; b < m_.bodies.size(); ++b) add_joint(static_cast<int>(b));
    for (std::size_t i = 0; i < m_.closures.size(); ++i) {
      const std::string name = "closure." + m_.closure_names[i];
      const int closure = static_cast<int>(i);
      add_vector(name + ".force", "N", Quantity::closure_force, closure);
      add_vector(name + ".torque", "N m", Quantity::closure_torque, closure);
      add_vector(name + ".gap", "m", Quantity::closure_gap, closure);
      add_clearances_of(closure, name);
    }
    for (std::size_t i = 0; i < m_.point_bodies.size(); ++i) add_point(i);
    add("energy.kinetic", "J", Quantity::kinetic, 0, 0);
    add("energy.potential", "J", Quantity::potential, 0, 0);
    add("energy.supplied", "J", Quantity::supplied, 0, 0);
    add("energy.dissipated", "J", Quantity::dissipated, 0, 0);
    add("energy.residual", "J", Quantity::residual, 0, 0);
    return std::move(channels_);
  }

 private:
  void add(std::string name, std::string unit, Quantity quantity, int index, int component) {
    channels_.push_back({std::move(name), std::move(unit), quantity, index, component});
  }

  void add_vector(const std::string& name, const std::string& unit, Quantity quantity, int index) {
    constexpr const char* axes[] = {".x", ".y", ".z"};
    for (int i = 0; i < 3; ++i) add(name + axes[i], unit, quantity, index, i);
  }

  void add_point(std::size_t i) {
    const std::string name = "point." + m_.point_names[i];
    const auto first = static_cast<std::ptrdiff_t>(channels_.size());
    const int index = static_cast<int>(i);
    add_vector(name + ".position", "m", Quantity::point_position, index);
    add_vector(name + ".velocity", "m/s", Quantity::point_velocity, index);
    add_vector(name + ".acceleration", "m/s^2", Quantity::point_acceleration, index);
    for (auto c = channels_.begin() + first; c != channels_.end(); ++c)
      c->body = m_.point_bodies[i];
  }

  void add_joint(int b) {
    const Body& body = m_.bodies[static_cast<std::size_t>(b)];
    const std::string name = "joint." + m_.joint_names[static_cast<std::size_t>(b)];
    const auto numbered = [](const std::string& base, int i, int count) {
      return count == 1 ? base : base + "." + std::to_string(i);
    };
    for (int i = 0; i < body.q_count; ++i) {
      const bool pure_number = body.q_count != body.v_count && i >= body.q_count - 4;
      const char* unit = pure_number ? "" : is_rotation(m_, body.v_begin + i) ? "rad" : "m";
      add(numbered(name + ".q", i, body.q_count), unit, Quantity::q, body.q_begin + i, 0);
    }
    for (int i = 0; i < body.v_count; ++i) {
      const bool rotation = is_rotation(m_, body.v_begin + i);
      add(numbered(name + ".v", i, body.v_count), rotation ? "rad/s" : "m/s", Quantity::v,
          body.v_begin + i, 0);
    }
    for (int i = 0; i < body.v_count; ++i) {
      const bool rotation = is_rotation(m_, body.v_begin + i);
      add(numbered(name + ".a", i, body.v_count), rotation ? "rad/s^2" : "m/s^2", Quantity::a,
          body.v_begin + i, 0);
    }
    add_vector(name + ".force", "N", Quantity::joint_force, b);
    add_vector(name + ".torque", "N m", Quantity::joint_torque, b);
    add_vector(name + ".force_local", "N", Quantity::joint_force_local, b);
    add_vector(name + ".torque_local", "N m", Quantity::joint_torque_local, b);
    add_friction_of(b, name);
  }

  void add_clearances_of(int closure, const std::string& name) {
    for (std::size_t i = 0; i < m_.clearances.size(); ++i) {
      const ClearanceStructure& c = m_.clearances[i];
      if (c.closure != closure) continue;
      const int index = static_cast<int>(i);
      add(name + ".eccentricity.x", "m", Quantity::eccentricity, index, 0);
      add(name + ".eccentricity.y", "m", Quantity::eccentricity, index, 1);
      add_contacts(c, name + ".penetration.", "m", Quantity::penetration);
      add_contacts(c, name + ".normal_force.", "N", Quantity::normal_force);
      add_contacts(c, name + ".friction_force.", "N", Quantity::friction_force);
      add_contacts(c, name + ".bristle.", "m", Quantity::bristle);
      add(name + ".contact_state", "", Quantity::contact_state, index, 0);
    }
  }

  // Bristles are found by their own number; contacts without friction have none.
  void add_contacts(const ClearanceStructure& c, const std::string& name, const std::string& unit,
                    Quantity quantity) {
    for (int i = c.contact_begin; i < c.contact_end; ++i) {
      const int z = m_.contacts[static_cast<std::size_t>(i)].z;
      const bool rubs = quantity == Quantity::friction_force || quantity == Quantity::bristle;
      if (rubs && z < 0) continue;
      add(name + std::to_string(i - c.contact_begin), unit, quantity,
          quantity == Quantity::bristle ? z : i, 0);
    }
  }

  void add_friction_of(int b, const std::string& name) {
    for (std::size_t i = 0; i < m_.frictions.size(); ++i) {
      const JointFrictionStructure& f = m_.frictions[i];
      if (f.body != b) continue;
      const int index = static_cast<int>(i);
      const bool both = f.turn >= 0 && f.slide >= 0;
      add(name + ".normal_load", "N", Quantity::friction_load, index, 0);
      if (f.turn >= 0) {
        add(name + (both ? ".friction.0" : ".friction"), "N m", Quantity::joint_friction, index, 0);
      }
      if (f.slide >= 0) {
        add(name + (both ? ".friction.1" : ".friction"), "N", Quantity::joint_friction, index, 1);
      }
      add(name + (both ? ".bristle.0" : ".bristle"), "m", Quantity::bristle, f.z, 0);
      if (both) add(name + ".bristle.1", "m", Quantity::bristle, f.z + 1, 0);
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
