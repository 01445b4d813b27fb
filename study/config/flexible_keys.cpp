// The keys of flexible links.
#include <fmt/format.h>

#include "core/topology/flexible_beam.h"
#include "study/config/beam_section.h"
#include "study/config/model_keys.h"
#include "study/config/read_value.h"
#include "study/config/rotation_reader.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Eigen::Vector3d;

// The inner diameter, once it is below the outer one.
double inner_diameter(Tree& section, double outer, const Reading& reading) {
  Tree* inner = section.find("inner");
  const double diameter = number_of(section, "inner", 0.5 * outer);
  if (!are_known(section, {"inner", "outer"}) || diameter < outer) return diameter;
  reading.report(*inner,
                 fmt::format("{} must be below outer = {:.9g} m, got {:.9g} m",
                             subject_of(reading.scope, "inner"), outer, diameter),
                 "give both as diameters; a full section has shape = \"circle\"");
  return 0.5 * outer;
}

// What was reported stands for a section that the checks of the core accept.
BeamSection section_of(Tree& table, const Reading& reading) {
  const auto size = [&](const char* key) { return number_of(table, key, 1.0); };
  switch (find_word<SectionShape>(word_of(table, "shape")).value_or(SectionShape::circle)) {
    case SectionShape::tube:
      return tube_section(size("outer"), inner_diameter(table, size("outer"), reading));
    case SectionShape::rectangle:
      return rectangle_section(size("width"), size("height"));
    case SectionShape::given:
      return {size("second_moment_y"), size("second_moment_z"), size("torsion_constant")};
    case SectionShape::circle:
      break;
  }
  return circle_section(size("diameter"));
}

void read_section(FlexibleBeam& beam, Tree& table, const Reading& reading) {
  const BeamSection section = section_of(table, reading);
  beam.second_moment_y = section.second_moment_y;
  beam.second_moment_z = section.second_moment_z;
  beam.torsion_constant = section.torsion_constant;
}

Fields<FlexibleBeam> section_fields() {
  Fields<FlexibleBeam> section;
  section.read_word<SectionShape>(
      "shape", {.meaning = "shape whose moments are computed, or given: moments themselves",
                .required = true});
  const auto add_size = [&](SectionShape shape, const char* key, const char* unit,
                            const char* meaning) {
    section.read(key, {.meaning = meaning,
                       .unit = unit,
                       .range = kPositive,
                       .required = true,
                       .only = only_where("shape", {shape})});
  };
  using enum SectionShape;
  add_size(circle, "diameter", "m", "diameter");
  add_size(tube, "outer", "m", "outer diameter");
  add_size(tube, "inner", "m", "inner diameter, below outer");
  add_size(rectangle, "width", "m", "side along `across`, the beam's y");
  add_size(rectangle, "height", "m", "side along the beam's z");
  add_size(given, "second_moment_y", "m^4", "integral z^2 dA: bending about the beam's y");
  add_size(given, "second_moment_z", "m^4", "integral y^2 dA: bending about the beam's z");
  add_size(given, "torsion_constant", "m^4",
           "J_t in torque = G J_t twist; y plus z only for circles");
  return section;
}

// The axis of the link that makes the largest angle with the beam.
std::optional<Tree> choose_across(const Tree& link) {
  const Tree& flexible = *link.find("flexible");
  const auto end = [&](const char* key, const Vector3d& otherwise) {
    return read_vector(flexible.find(key), otherwise);
  };
  const Vector3d begin = end("begin", Vector3d::Zero());
  Eigen::Index least = 0;
  (end("end", begin + Vector3d::UnitX()) - begin).cwiseAbs().minCoeff(&least);
  Tree axis = Tree::make_array();
  for (const double component : Vector3d(Vector3d::Unit(least))) {
    axis.items.push_back(Tree::make_number(component));
  }
  return axis;
}

Fields<FlexibleBeam> bent_fields() {
  Fields<FlexibleBeam> start;
  start.add("position", &FlexibleBeam::position,
            {.meaning = "angles psi, theta, phi of every element from begin to end, each about z, "
                        "the new y, the new x of the beam; default: straight",
             .unit = "rad"});
  start.add("velocity", &FlexibleBeam::velocity,
            {.meaning = "their rates; default: at rest", .unit = "rad/s"});
  return start;
}

}  // namespace

Fields<FlexibleBeam> flexible_fields() {
  Fields<FlexibleBeam> beam;
  beam.add("segments", &FlexibleBeam::segments,
           {.meaning = "number n of spring-damping elements (sdes), each in the middle of length / "
                       "n; the rigid elements are n + 1, the outer two half as long ([AugUrb18] "
                       "has 5 of them: 4 segments)",
            .range = {.low = 1, .high = kMostSegments}});
  beam.add("begin", &FlexibleBeam::begin,
           {.meaning = "begin of the beam in the link frame", .unit = "m", .counts = {3}});
  beam.add("end", &FlexibleBeam::end,
           {.meaning = "end of the beam in the link frame",
            .unit = "m",
            .required = true,
            .counts = {3}});
  beam.add(
      "across", &FlexibleBeam::across,
      {.meaning = "direction, of any length, that becomes the beam's y once made perpendicular "
                  "to the beam; default: the link axis least along it",
       .counts = {3},
       .derive = choose_across},
      [](FlexibleBeam& to, Tree& value, const Reading& reading) {
        normalise_direction(to.across, value, reading);
      });
  beam.add("young", &FlexibleBeam::young,
           {.meaning = "modulus of elasticity E; bending stiffness E J n / length",
            .unit = "Pa",
            .range = kPositive,
            .required = true});
  beam.add("shear", &FlexibleBeam::shear,
           {.meaning = "shear modulus G; torsional stiffness G J_t n / length",
            .unit = "Pa",
            .range = kPositive,
            .required = true});
  beam.add("retardation", &FlexibleBeam::retardation,
           {.meaning = "eta / E of Kelvin and Voigt: damping = stiffness times this",
            .unit = "s",
            .range = kNotNegative});
  beam.table("section",
             {.meaning = "cross-section of the beam, the same along it", .required = true},
             section_fields(), read_section);
  beam.table("initial",
             {.meaning = "start of the beam, held while the rest is assembled; statics bends it "
                         "anew; default: straight and at rest"},
             bent_fields());
  return beam;
}

}  // namespace linkstudy
