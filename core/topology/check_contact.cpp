#include "core/topology/check_contact.h"

#include <algorithm>
#include <cmath>

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

void check_contact(const Clearance& clearance, RecordCheck& record) {
  const double restitution = clearance.restitution;
  if (!(restitution > 0.0 && restitution <= 1.0)) {
    record.report(
        "contact.restitution",
        "contact.restitution must lie above 0 and not above 1, got " + text_of(restitution),
        "1 loses no energy; metals have 0.5 to 0.95");
  }
  if (!(std::isfinite(clearance.exponent) && clearance.exponent >= 1.0)) {
    record.report("contact.exponent",
                  "contact.exponent must be 1 or more, got " + text_of(clearance.exponent),
                  "1.5 is Hertz's for metals, 1 a linear spring");
  }
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

void check_joint_friction(const Joint& joint, RecordCheck& record) {
  const JointFriction& friction = *joint.friction;
  const bool turns = joint.type == JointType::revolute || joint.type == JointType::cylindrical;
  if (!turns && joint.type != JointType::prismatic) {
    record.report("friction", "friction is known for revolute, prismatic and cylindrical joints",
                  "take it off, or change the type of the joint");
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

void check_clearance(const Closure& closure, RecordCheck& record) {
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
