// The keys of clearance and of its contact.
#include "study/config/model_keys.h"

#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using enum KeyType;

Fields<Material> material_fields(const std::string& body) {
  Fields<Material> material;
  material.add(
      "young", &Material::young,
      {.meaning = "modulus of elasticity of the " + body, .unit = "Pa", .range = kPositive});
  material.add("poisson", &Material::poisson,
               {.meaning = "Poisson's ratio of the " + body,
                .range = {.low = -1.0, .high = 0.5, .low_is_out = true}});
  return material;
}

void add_material(Fields<Clearance>& contact, const std::string& body,
                  Material Clearance::*member) {
  contact.table(body, member,
                {.meaning = "material of the " + body + ", where `stiffness` is not given",
                 .standard = "{}",
                 .effects = {{"closure.*.contact.stiffness", {}, {}, false}}},
                material_fields(body));
}

// One that was reported stands for a number all the same.
void keep_given(Clearance& clearance, Tree& contact, const Reading&) {
  if (!are_known(contact, {"stiffness"})) clearance.stiffness = 1.0;
}

}  // namespace

Fields<Clearance> clearance_fields() {
  Fields<Clearance> clearance;
  clearance.add("kind", &Clearance::kind, {});
  clearance.add_choice("bearing", &Clearance::bearing_is_first, kBearingEnds,
                       {.meaning = "end that carries the bearing; the other carries the journal"});
  clearance.add("radial", &Clearance::radial,
                {.meaning = "radial clearance: radius of the bearing less that of the journal",
                 .unit = "m",
                 .range = kPositive,
                 .required = true});
  clearance.add("bearing_radius", &Clearance::bearing_radius,
                {.meaning = "radius of the bearing, above `radial`",
                 .unit = "m",
                 .range = kPositive,
                 .required = true});
  clearance.read("length",
                 {.meaning = "length of the bearing; kind spatial needs it",
                  .unit = "m",
                  .range = kPositive,
                  .effects = {stands_by("closure.*.clearance.kind", {ClearanceKind::spatial})}},
                 [](Clearance& to, Tree& value, const Reading&) { to.length = value.as_number(); });
  return clearance;
}

Fields<Clearance> contact_fields() {
  Fields<Clearance> contact;
  contact.add("law", &Clearance::law,
              {.meaning = "D of the restitution e: 3 (1 - e^2) / 4, 8 (1 - e) / (5 e) or "
                          "3 (1 - e) / 2; the rebound equals e only near 1"});
  contact.add("restitution", &Clearance::restitution,
              {.meaning = "coefficient of restitution e of the law",
               .range = {.low = 0.0, .high = 1.0, .low_is_out = true}});
  contact.add("exponent", &Clearance::exponent,
              {.meaning = "power of the depth; 1.5 is that of Hertz", .range = {.low = 1.0}});
  contact.add("stiffness", &Clearance::stiffness,
              {.meaning = "K, a plain number in N/m^exponent; default: 4 / (3 (h_b + h_j)) "
                          "sqrt(r_b r_j / (r_b - r_j)), h = (1 - nu^2) / E, of the materials",
               .range = kPositive});
  add_material(contact, "bearing", &Clearance::bearing);
  add_material(contact, "journal", &Clearance::journal);
  contact.add("approach", &Clearance::approach, {.meaning = "approach speed of the law"});
  contact.add("least_speed", &Clearance::least_speed,
              {.meaning = "floor of the approach speed", .unit = "m/s", .range = kPositive});
  contact.add("points", &Clearance::points, {.meaning = "where friction acts"});
  contact.add("free_bristle", &Clearance::free_bristle,
              {.meaning = "bristle of the friction out of contact"});
  contact.finish(keep_given);
  return contact;
}

}  // namespace linkstudy
