// The keys of [[spring]].
#include "study/config/model_keys.h"
#include "study/config/read_value.h"
#include "study/config/table_files.h"

namespace linkstudy {
namespace {

using enum KeyType;

Fields<SpringEnd> spring_end_fields() {
  Fields<SpringEnd> end;
  end.add("link", &SpringEnd::link, {.type = name, .meaning = "link, or ground", .required = true});
  end.add("position", &SpringEnd::position,
          {.meaning = "point in the link frame", .unit = "m", .counts = {3}});
  return end;
}

Fields<ForceCurve> force_over_length_fields() {
  Fields<ForceCurve> curve;
  curve.add("lengths", &ForceCurve::at,
            {.meaning = "lengths, increasing, two or more", .unit = "m", .required = true});
  curve.add("forces", &ForceCurve::force,
            {.meaning = "forces at lengths, positive where the spring pulls its points together; "
                        "linear between, held outside",
             .unit = "N",
             .required = true});
  add_table_file(curve, {}, {{"length", "lengths"}, {"force", "forces"}});
  return curve;
}

// What was reported is no course and no table.
void leave_unknown_actuator(PointSpring& spring, Tree& course, const Reading&) {
  const bool is_known = are_known(
      course, {"shape", "value", "duration", "times", "positions", "values", "period", "over"});
  if (!is_known) spring.course.reset();
}
void leave_unknown_table(PointSpring& spring, Tree& table, const Reading&) {
  if (!are_known(table, {"lengths", "forces"})) spring.force.reset();
}

// Whether a free length is missing is a question where the rest is what the user wrote.
void leave_unknown_law(PointSpring& spring, Tree& table, const Reading&) {
  if (!are_known(table, {"stiffness", "damping", "free_length", "acts", "force"})) {
    spring.stiffness = spring.damping = 0.0;
  }
}

}  // namespace

Fields<PointSpring> point_spring_fields() {
  Fields<PointSpring> spring;
  spring.add("name", &PointSpring::name,
             {.type = name, .meaning = "name of the spring", .required = true});
  spring.table("first", &PointSpring::first, {.meaning = "one end", .required = true},
               spring_end_fields());
  spring.table("second", &PointSpring::second, {.meaning = "the other end", .required = true},
               spring_end_fields());
  spring.add("stiffness", &PointSpring::stiffness,
             {.meaning = "k of the force k (length - free_length), positive where it pulls the "
                         "points together",
              .unit = "N/m",
              .range = kNotNegative,
              .group = "elastic"});
  spring.add("free_length", &PointSpring::free_length,
             {.meaning = "length without force; needed where stiffness is above 0, and by a damper "
                         "that acts on one side",
              .unit = "m",
              .range = kNotNegative,
              .effects = {{"spring.*.force", {}, {}, false}}});
  spring.add("damping", &PointSpring::damping,
             {.meaning = "b of the damper beside it, force b * rate of the length",
              .unit = "N s/m",
              .range = kNotNegative});
  spring.add("acts", &PointSpring::acts,
             {.meaning = "side on which spring and damper act; an actuator always does"});
  spring.table(
      "force", &PointSpring::force,
      {.meaning = "force over length in place of stiffness and free_length", .group = "elastic"},
      force_over_length_fields(), leave_unknown_table);
  spring.table("course", &PointSpring::course,
               {.meaning = "force of an actuator over time or a joint coordinate, positive where "
                           "it pulls the points "
                           "together; default: none"},
               course_fields("N", {}), leave_unknown_actuator);
  spring.finish(leave_unknown_law);
  return spring;
}

}  // namespace linkstudy
