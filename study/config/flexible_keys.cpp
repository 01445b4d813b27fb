// The keys of flexible links.
#include "study/config/model_keys.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Rows = std::vector<KeyRow>;

void add_size_row(Rows& rows, const std::string& shape, const std::string& key,
                  const std::string& unit, const std::string& meaning) {
  rows.push_back({.path = "link.*.flexible.section." + key,
                  .type = number,
                  .meaning = meaning,
                  .unit = unit,
                  .range = kPositive,
                  .required = true,
                  .only = {"shape", {shape}}});
}

void add_section_rows(Rows& rows) {
  const std::string section = "link.*.flexible.section";
  rows.push_back({.path = section,
                  .type = table,
                  .meaning = "cross-section of the beam, the same along it",
                  .required = true});
  rows.push_back({.path = section + ".shape",
                  .type = word,
                  .meaning = "shape whose moments are computed, or given: moments themselves",
                  .required = true,
                  .words = {"circle", "tube", "rectangle", "given"}});
  add_size_row(rows, "circle", "diameter", "m", "diameter");
  add_size_row(rows, "tube", "outer", "m", "outer diameter");
  add_size_row(rows, "tube", "inner", "m", "inner diameter, below outer");
  add_size_row(rows, "rectangle", "width", "m", "side along `across`, the beam's y");
  add_size_row(rows, "rectangle", "height", "m", "side along the beam's z");
  add_size_row(rows, "given", "second_moment_y", "m^4",
               "integral z^2 dA: bending about the beam's y");
  add_size_row(rows, "given", "second_moment_z", "m^4",
               "integral y^2 dA: bending about the beam's z");
  add_size_row(rows, "given", "torsion_constant", "m^4",
               "J_t in torque = G J_t twist; y plus z only for circles");
}

void add_modulus_row(Rows& rows, const std::string& key, const std::string& meaning) {
  rows.push_back({.path = "link.*.flexible." + key,
                  .type = number,
                  .meaning = meaning,
                  .unit = "Pa",
                  .range = kPositive,
                  .required = true});
}

}  // namespace

void add_flexible_rows(Rows& rows) {
  const std::string f = "link.*.flexible";
  rows.push_back({.path = f,
                  .type = table,
                  .meaning = "the link as a uniform beam of rigid finite elements; mass, centre "
                             "and inertia stay those of the link"});
  rows.back().effects.push_back(when_enabled(f));
  rows.push_back({.path = f + ".enabled",
                  .type = boolean,
                  .meaning = "false: rigid, whatever the table says",
                  .standard = "true"});
  rows.push_back({.path = f + ".segments",
                  .type = integer,
                  .meaning = "number n of spring-damping elements (sdes), each in the middle of "
                             "length / n; the rigid elements are n + 1, the outer two half as "
                             "long ([AugUrb18] has 5 of them: 4 segments)",
                  .range = {.low = 1, .high = 200},
                  .standard = "4"});
  for (const char* end : {"begin", "end"}) {
    rows.push_back({.path = f + "." + end,
                    .type = numbers,
                    .meaning = std::string(end) + " of the beam in the link frame",
                    .unit = "m",
                    .required = std::string(end) == "end",
                    .standard = std::string(end) == "end" ? "" : "[0.0, 0.0, 0.0]",
                    .counts = {3}});
  }
  rows.push_back({.path = f + ".across",
                  .type = numbers,
                  .meaning = "direction, of any length, that becomes the beam's y once made "
                             "perpendicular to the beam; default: the link axis least along it",
                  .counts = {3}});
  add_modulus_row(rows, "young", "modulus of elasticity E; bending stiffness E J n / length");
  add_modulus_row(rows, "shear", "shear modulus G; torsional stiffness G J_t n / length");
  rows.push_back({.path = f + ".retardation",
                  .type = number,
                  .meaning = "eta / E of Kelvin and Voigt: damping = stiffness times this",
                  .unit = "s",
                  .range = kNotNegative,
                  .standard = "0.0"});
  add_section_rows(rows);
}

}  // namespace linkstudy
