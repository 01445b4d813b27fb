// The keys of friction and of clearance.
#include "study/config/model_keys.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Rows = std::vector<KeyRow>;

Effect of_clearance() {
  return acts_where("closure.*.model", {"clearance"}, "closure.*.clearance");
}

void add_clearance_table(Rows& rows) {
  const std::string c = "closure.*.clearance";
  rows.push_back({.path = c,
                  .type = table,
                  .meaning = "settings of model clearance, for revolute closures; constraints that "
                             "remain are held as `cut` says",
                  .effects = {stands_by("closure.*.model", {"clearance"})}});
  rows.push_back({.path = c + ".kind",
                  .type = word,
                  .meaning = "planar: axes stay parallel, one contact; spatial: the journal's axis "
                             "may skew, a contact at either end of the bearing; in both nothing "
                             "moves along the axis",
                  .standard = "\"planar\"",
                  .words = {"planar", "spatial"}});
  rows.push_back({.path = c + ".bearing",
                  .type = word,
                  .meaning = "end that carries the bearing; the other carries the journal",
                  .standard = "\"second\"",
                  .words = {"second", "first"}});
  rows.push_back({.path = c + ".radial",
                  .type = number,
                  .meaning = "radial clearance: radius of the bearing less that of the journal",
                  .unit = "m",
                  .range = kPositive,
                  .required = true});
  rows.push_back({.path = c + ".bearing_radius",
                  .type = number,
                  .meaning = "radius of the bearing, above `radial`",
                  .unit = "m",
                  .range = kPositive,
                  .required = true});
  rows.push_back({.path = c + ".length",
                  .type = number,
                  .meaning = "length of the bearing; kind spatial needs it",
                  .unit = "m",
                  .range = kPositive,
                  .effects = {stands_by(c + ".kind", {"spatial"})}});
}

void add_material_rows(Rows& rows, const std::string& path, const std::string& body) {
  rows.push_back({.path = path,
                  .type = table,
                  .meaning = "material of the " + body + ", where `stiffness` is not given",
                  .standard = "{}",
                  .effects = {acts_where("closure.*.contact.stiffness", {})}});
  rows.push_back({.path = path + ".young",
                  .type = number,
                  .meaning = "modulus of elasticity of the " + body,
                  .unit = "Pa",
                  .range = kPositive,
                  .standard = "2.07e11"});
  rows.push_back({.path = path + ".poisson",
                  .type = number,
                  .meaning = "Poisson's ratio of the " + body,
                  .range = {.low = -1.0, .high = 0.5, .low_is_out = true},
                  .standard = "0.3"});
}

void add_normal_rows(Rows& rows) {
  const std::string c = "closure.*.contact";
  rows.push_back({.path = c,
                  .type = table,
                  .meaning = "normal force of model clearance, K depth^exponent (1 + D rate / "
                             "approach speed); default: steel on steel",
                  .effects = {of_clearance()}});
  rows.push_back({.path = c + ".law",
                  .type = word,
                  .meaning = "D of the restitution e: 3 (1 - e^2) / 4, 8 (1 - e) / (5 e) or "
                             "3 (1 - e) / 2; the rebound equals e only near 1",
                  .standard = "\"lankarani_nikravesh\"",
                  .words = {"lankarani_nikravesh", "flores", "hunt_crossley"}});
  rows.push_back({.path = c + ".restitution",
                  .type = number,
                  .meaning = "coefficient of restitution e of the law",
                  .range = {.low = 0.0, .high = 1.0, .low_is_out = true},
                  .standard = "0.9"});
  rows.push_back({.path = c + ".exponent",
                  .type = number,
                  .meaning = "power of the depth; 1.5 is that of Hertz",
                  .range = {.low = 1.0},
                  .standard = "1.5"});
  rows.push_back({.path = c + ".stiffness",
                  .type = number,
                  .meaning = "K, a plain number in N/m^exponent; default: 4 / (3 (h_b + h_j)) "
                             "sqrt(r_b r_j / (r_b - r_j)), h = (1 - nu^2) / E, of the materials",
                  .range = kPositive});
  add_material_rows(rows, c + ".bearing", "bearing");
  add_material_rows(rows, c + ".journal", "journal");
  rows.push_back({.path = c + ".approach",
                  .type = word,
                  .meaning = "approach speed of the law: that at which this contact began, as "
                             "printed, or the greatest speed of the contact so far",
                  .standard = "\"begin\"",
                  .words = {"begin", "greatest"}});
  rows.push_back({.path = c + ".least_speed",
                  .type = number,
                  .meaning = "floor of the approach speed",
                  .unit = "m/s",
                  .range = kPositive,
                  .standard = "1.0e-4"});
  rows.push_back({.path = c + ".points",
                  .type = word,
                  .meaning = "where friction acts: on both at one point of the bearing's surface, "
                             "or on each at its own surface, a penetration apart, as printed (the "
                             "two forces then are a couple)",
                  .standard = "\"one\"",
                  .words = {"one", "two"}});
  rows.push_back({.path = c + ".free_bristle",
                  .type = word,
                  .meaning = "bristle of the friction out of contact: zero, relaxing by z' = "
                             "-(sigma0 / sigma1) z, or kept",
                  .standard = "\"reset\"",
                  .words = {"reset", "relax", "hold"}});
}

}  // namespace

void add_friction_rows(Rows& rows, const std::string& path) {
  rows.push_back({.path = path + ".enabled",
                  .type = boolean,
                  .meaning = "false: no friction, whatever the table says",
                  .standard = "true"});
  const auto add = [&](const char* key, const char* meaning, const char* unit, const char* standard,
                       const Range& range) {
    rows.push_back({.path = path + "." + key,
                    .type = number,
                    .meaning = meaning,
                    .unit = unit,
                    .range = range,
                    .required = *standard == 0,
                    .standard = standard});
  };
  add("mu_s", "static coefficient, not below mu_k", "", "", kPositive);
  add("mu_k", "kinetic coefficient", "", "", kPositive);
  add("stribeck_speed", "v_s: the static part falls as exp(-(v / v_s)^2)", "m/s", "0.01",
      kPositive);
  add("sigma0", "stiffness of the bristle", "1/m", "", kPositive);
  add("sigma1", "damping of the bristle", "s/m", "0.0", kNotNegative);
  add("sigma2", "viscous coefficient", "s/m", "0.0", kNotNegative);
  add("damping_speed", "v_d: sigma1 is weighted by exp(-(v / v_d)^2); 0: not weighted", "m/s",
      "0.0", kNotNegative);
}

void add_clearance_rows(Rows& rows) {
  const std::string friction = "closure.*.friction";
  add_clearance_table(rows);
  add_normal_rows(rows);
  rows.push_back({.path = friction,
                  .type = table,
                  .meaning = "LuGre friction of model clearance, mu = sigma0 z + sigma1 z' + "
                             "sigma2 v; default: none",
                  .effects = {of_clearance(), when_enabled(friction)}});
  add_friction_rows(rows, friction);
}

}  // namespace linkstudy
