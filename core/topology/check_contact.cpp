#include "core/topology/check_contact.h"

#include <algorithm>
#include <cmath>

#include "core/base/ensure.h"

namespace linkstudy {
namespace {

void check_material(const std::string& key, const Material& material, RecordCheck& record) {
  record.require_positive(key + ".young", material.young);
  if (material.poisson > -1.0 && material.poisson <= 0.5) return;
  record.report(
      key + ".poisson",
      key + ".poisson must lie above -1 and not above 0.5, got " + text_of(material.poisson),
      "give Poisson's ratio of the material; steel has 0.3");
}

void check_size(const Clearance& clearance, RecordCheck& record) {
  const bool from_materials = !clearance.stiffness;
  if (from_materials) {
    record.require_positive("clearance.radial", clearance.radial);
  } else {
    record.require_not_negative("clearance.radial", clearance.radial);
  }
  const double radius = clearance.bearing_radius;
  const bool needed = from_materials || clearance.friction;
  const bool right = std::isfinite(radius) && radius > std::max(clearance.radial, 0.0);
  if (!right && (needed || radius != 0.0)) {
    record.report("clearance.bearing_radius",
                  "clearance.bearing_radius must exceed clearance.radial = " +
                      text_of(clearance.radial) + ", got " + text_of(radius),
                  "the journal's radius is their difference; friction and stiffness from materials "
                  "need both radii");
  }
  if (clearance.kind == ClearanceKind::spatial) {
    record.require_positive("clearance.length", clearance.length);
  } else {
    record.require_not_negative("clearance.length", clearance.length);
  }
}

// Keys are those of `table`.
void check_impact(const std::string& table, double restitution, double exponent,
                  RecordCheck& record) {
  if (!(restitution > 0.0 && restitution <= 1.0)) {
    record.report(
        table + ".restitution",
        table + ".restitution must lie above 0 and not above 1, got " + text_of(restitution),
        "1 loses no energy; metals have 0.5 to 0.95");
  }
  if (!(std::isfinite(exponent) && exponent >= 1.0)) {
    record.report(table + ".exponent",
                  table + ".exponent must be 1 or more, got " + text_of(exponent),
                  "1.5 is Hertz's for metals, 1 a linear spring");
  }
}

// One entry for each coordinate, or none where it may be left out.
bool has_entries(const std::string& key, const std::vector<double>& values, int count,
                 bool may_miss, RecordCheck& record) {
  if (values.empty() && may_miss) return true;
  if (static_cast<int>(values.size()) == count) {
    record.require_finite(key, all_finite(values));
    return all_finite(values);
  }
  record.report(key,
                key + " must have " + std::to_string(count) + (count == 1 ? " entry" : " entries") +
                    " for this joint, got " + std::to_string(values.size()),
                "give one entry for each coordinate");
  return false;
}

void check_contact(const Clearance& clearance, RecordCheck& record) {
  check_impact("contact", clearance.restitution, clearance.exponent, record);
  record.require_positive("contact.least_speed", clearance.least_speed);
  if (clearance.stiffness) {
    record.require_positive("contact.stiffness", *clearance.stiffness);
    return;
  }
  if (clearance.exponent >= 1.0 && clearance.exponent != 1.5) {
    record.report("contact.exponent",
                  "contact.exponent must be 1.5 where K follows from the materials, got " +
                      text_of(clearance.exponent),
                  "give contact.stiffness, K in N/m^exponent");
  }
  check_material("contact.bearing", clearance.bearing, record);
  check_material("contact.journal", clearance.journal, record);
}

}  // namespace

void check_friction(const Friction& friction, RecordCheck& record) {
  record.require_positive("friction.mu_k", friction.mu_k);
  if (!(std::isfinite(friction.mu_s) && friction.mu_s >= friction.mu_k)) {
    record.report("friction.mu_s",
                  "friction.mu_s must not be below friction.mu_k = " + text_of(friction.mu_k) +
                      ", got " + text_of(friction.mu_s),
                  "static friction is the larger; give mu_s = mu_k for none beyond the kinetic");
  }
  record.require_positive("friction.stribeck_speed", friction.v_s);
  record.require_positive("friction.sigma0", friction.sigma0);
  record.require_not_negative("friction.sigma1", friction.sigma1);
  record.require_not_negative("friction.sigma2", friction.sigma2);
  record.require_not_negative("friction.damping_speed", friction.v_d);
}

namespace {

// A constant load acts in every joint that moves; what it presses on has to be there.
void check_constant_friction(const Joint& joint, RecordCheck& record) {
  const JointFriction& friction = *joint.friction;
  if (velocity_count(joint.type) == 0) {
    record.report("friction", "nothing slides in a fixed joint", "take it off");
    return;
  }
  check_friction(friction.law, record);
  record.require_positive("friction.preload", friction.preload);
  const bool slides_too = joint.type == JointType::planar || joint.type == JointType::free;
  if (slides_too) {
    record.require_not_negative("friction.radius", friction.radius);
  } else if (joint.type != JointType::prismatic) {
    record.require_positive("friction.radius", friction.radius);
  } else if (friction.radius != 0.0) {
    record.report("friction.radius",
                  "under a constant load the radius of a prismatic joint has no effect",
                  "take it off, or use load = \"reaction\"");
  }
}

}  // namespace

void check_joint_friction(const Joint& joint, RecordCheck& record) {
  const JointFriction& friction = *joint.friction;
  if (friction.load == FrictionLoad::constant) return check_constant_friction(joint, record);
  const bool turns = joint.type == JointType::revolute || joint.type == JointType::cylindrical;
  if (!turns && joint.type != JointType::prismatic) {
    record.report("friction",
                  "friction under the joint's own reaction is known for revolute, prismatic and "
                  "cylindrical joints",
                  "use load = \"constant\" with a preload, or take it off");
    return;
  }
  check_friction(friction.law, record);
  if (turns) {
    record.require_positive("friction.radius", friction.radius);
  } else {
    record.require_not_negative("friction.radius", friction.radius);
  }
  record.require_not_negative("friction.length", friction.length);
  record.require_not_negative("friction.preload", friction.preload);
}

void check_stops(const Joint& joint, RecordCheck& record) {
  ensure(joint.stop.has_value(), "the joint has stops");
  const JointStops& stop = *joint.stop;
  const int count = velocity_count(joint.type);
  if (count == 0 || position_count(joint.type, joint.coordinates) != count) {
    record.report("stop", "a stop ends the way of coordinates, which this joint has not",
                  count == 0 ? "take it off" : "use coordinates = \"zyx\"");
    return;
  }
  check_impact("stop", stop.restitution, stop.exponent, record);
  const bool low = has_entries("stop.low", stop.low, count, true, record);
  const bool high = has_entries("stop.high", stop.high, count, true, record);
  const bool stiffness = has_entries("stop.stiffness", stop.stiffness, count, false, record);
  if (has_entries("stop.damping", stop.damping, count, true, record)) {
    for (const double b : stop.damping) record.require_not_negative("stop.damping", b);
  }
  if (!low || !high || !stiffness) return;
  if (stop.low.empty() && stop.high.empty()) {
    record.report("stop", "neither low nor high is given", "give one of them or both");
  }
  for (std::size_t i = 0; i < stop.stiffness.size(); ++i) {
    record.require_not_negative("stop.stiffness." + std::to_string(i), stop.stiffness[i]);
    const bool both = !stop.low.empty() && !stop.high.empty() && stop.stiffness[i] > 0.0;
    if (!both || stop.low[i] < stop.high[i]) continue;
    record.report("stop.low." + std::to_string(i),
                  "stop.low must lie below stop.high, got " + text_of(stop.low[i]) + " and " +
                      text_of(stop.high[i]),
                  "swap them; stiffness 0 takes the stops off a coordinate");
  }
}

void check_clearance(const Closure& closure, RecordCheck& record) {
  ensure(closure.model == ClosureModel::clearance, "the closure has a clearance");
  const Clearance& clearance = closure.clearance;
  if (closure.type != JointType::revolute) {
    record.report("type", "model = \"clearance\" is for a closure of type revolute",
                  "use type = \"revolute\", or model = \"cut\" or \"sde\"");
  }
  check_size(clearance, record);
  check_contact(clearance, record);
  if (!clearance.friction) return;
  check_friction(*clearance.friction, record);
  if (clearance.free_bristle == FreeBristle::relax && clearance.friction->sigma1 == 0.0) {
    record.report("contact.free_bristle",
                  "contact.free_bristle = \"relax\" takes the time sigma1 / sigma0, but "
                  "friction.sigma1 is 0",
                  "use \"reset\", or give sigma1 above 0");
  }
}

}  // namespace linkstudy
