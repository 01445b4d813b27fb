// The keys of [[load]].
#include <fmt/format.h>

#include "study/config/joint_units.h"
#include "study/config/model_keys.h"
#include "study/config/read_value.h"
#include "study/config/rotation_reader.h"
#include "study/config/table_files.h"

namespace linkstudy {
namespace {

using enum KeyType;

// "rad/s" or "m/s" of the coordinate a load acts on, when joint, type and coordinate are right.
std::optional<std::string> speed_unit(const Tree& document, const Tree& load) {
  const Tree* joint = find_named(document, "joint", word_of(load, "joint"));
  if (joint == nullptr) return std::nullopt;
  const JointKind kind = joint_kind_of(*joint);
  const std::vector<std::string> units = velocity_units(kind);
  const auto index = static_cast<std::size_t>(number_of(load, "coordinate", 0.0));
  if (!kind.is_known || index >= units.size()) return std::nullopt;
  return units[index];
}

std::vector<std::string> course_units(const Tree&, const Tree& load) {
  const std::optional<LoadKind> kind = find_word<LoadKind>(word_of(load, "type"));
  if (!kind) return {};
  return {*kind == LoadKind::force || *kind == LoadKind::link_force ? "N" : "N m"};
}

std::vector<std::string> resistance_units(const Tree& document, const Tree& load) {
  const std::optional<std::string> speed = speed_unit(document, load);
  if (!speed) return {};
  return {*speed == "rad/s" ? "N m" : "N"};
}

std::vector<std::string> resisted_speed_units(const Tree& document, const Tree& load) {
  const std::optional<std::string> speed = speed_unit(document, load);
  return speed ? std::vector<std::string>{*speed} : std::vector<std::string>();
}

// What was reported is no course: a constant takes the fewest keys.
void leave_unknown_course(Load& load, Tree& course, const Reading&) {
  if (!are_known(course, {"shape", "duration", "times", "positions", "values", "period", "over"})) {
    load.course.shape = CourseShape::constant;
  }
}

Fields<ResistanceLaw> law_fields() {
  Fields<ResistanceLaw> law;
  law.add("shape", &ResistanceLaw::shape, {});
  law.add("value", &ResistanceLaw::value,
          {.meaning = "resistance at at_speed",
           .unit = "N|N m",
           .required = true,
           .units_by = resistance_units});
  law.add("at_speed", &ResistanceLaw::at_speed,
          {.meaning = "speed of `value`",
           .unit = "rad/s|m/s",
           .range = kPositive,
           .required = true,
           .units_by = resisted_speed_units});
  return law;
}

void read_type(Load& load, Tree& value, const Reading&) {
  switch (*find_word<LoadKind>(value.text)) {
    case LoadKind::torque:
    case LoadKind::force:
      load.type = LoadType::drive;
      break;
    case LoadKind::resistance:
      load.type = LoadType::resistance;
      break;
    case LoadKind::link_force:
      load.type = LoadType::link_force;
      break;
    case LoadKind::link_torque:
      load.type = LoadType::link_torque;
  }
}

// A torque turns, a force shifts.
void require_fit(Load& load, Tree& table, const Reading& reading) {
  const std::string type = word_of(table, "type");
  const std::optional<LoadKind> kind = find_word<LoadKind>(type);
  const bool is_torque = kind == LoadKind::torque;
  if (!is_torque && kind != LoadKind::force) return;
  const std::optional<std::string> speed = speed_unit(reading.document, table);
  if (!speed || (*speed == "rad/s") == is_torque) return;
  reading.diagnostics.add(
      table.find("type")->at,
      fmt::format("{}type {} does not fit coordinate {} of joint '{}', a {}, got '{}'",
                  subject_of(reading.scope), type, load.coordinate, load.joint,
                  is_torque ? "translation" : "rotation", type),
      fmt::format("use type = \"{}\"", name_of(is_torque ? LoadKind::force : LoadKind::torque)));
}

void add_place(Fields<Load>& load) {
  using enum LoadKind;
  const Condition on_joint = only_where("type", {torque, force, resistance});
  const Condition on_link = only_where("type", {link_force, link_torque});
  load.add("joint", &Load::joint,
           {.type = name, .meaning = "joint it acts on", .required = true, .only = on_joint});
  load.add("coordinate", &Load::coordinate,
           {.meaning = "velocity coordinate within the joint, from 0",
            .range = {.low = 0, .high = 5},
            .only = on_joint});
  load.add("link", &Load::link,
           {.type = name, .meaning = "link it acts on", .required = true, .only = on_link});
  load.add("point", &Load::point,
           {.meaning = "point of application in the link frame",
            .unit = "m",
            .counts = {3},
            .only = only_where("type", {link_force})});
  load.add(
      "direction", &Load::direction,
      {.meaning = "direction, of any length", .required = true, .counts = {3}, .only = on_link},
      [](Load& to, Tree& value, const Reading& reading) {
        normalise_direction(to.direction, value, reading);
      });
  load.add_choice("axes", &Load::follows_link, kLoadAxes,
                  {.meaning = "frame of direction", .only = on_link});
}

}  // namespace

namespace {

// "rad" or "m" of the coordinate that a course goes over; nothing where it goes by time.
std::optional<std::string> over_unit(const Tree& document, const Tree& element) {
  const Tree* course = element.find("course");
  const Tree* over = course == nullptr ? nullptr : course->find("over");
  if (over == nullptr || !over->is(Tree::Kind::table)) return std::nullopt;
  const std::optional<std::string> unit =
      position_unit(document, word_of(*over, "joint"), integer_of(*over, "coordinate", 0));
  return unit && *unit != "1" ? unit : std::nullopt;  // the checks report a quaternion
}

std::vector<std::string> over_units(const Tree& document, const Tree& element) {
  const std::optional<std::string> unit = over_unit(document, element);
  return unit ? std::vector<std::string>{*unit} : std::vector<std::string>();
}

std::vector<std::string> period_units(const Tree& document, const Tree& element) {
  const Tree* course = element.find("course");
  if (course == nullptr) return {};
  const bool by_time = course->find("over") == nullptr;
  return by_time ? std::vector<std::string>{"s"} : over_units(document, element);
}

Fields<JointCoordinate> over_fields() {
  Fields<JointCoordinate> over;
  over.add("joint", &JointCoordinate::joint,
           {.type = name, .meaning = "joint of the tree", .required = true});
  over.add("coordinate", &JointCoordinate::coordinate,
           {.meaning = "coordinate within the joint, from 0; none of a quaternion",
            .range = {.low = 0, .high = 5}});
  return over;
}

void add_table(const std::string& unit, const UnitsBy& units_by, Fields<Course>& course) {
  const Condition in_table = only_where("shape", {CourseShape::table});
  course.table(
      "over", &Course::over,
      {.meaning = "joint coordinate that positions are of, such as a crank angle; default: "
                  "a table over time",
       .only = in_table},
      over_fields());
  course.add("times", &Course::times,
             {.meaning = "times, increasing",
              .unit = "s",
              .required = true,
              .group = "points",
              .only = in_table});
  course.add("positions", &Course::positions,
             {.meaning = "values of the coordinate `over`, increasing",
              .unit = "rad|m",
              .required = true,
              .group = "points",
              .only = in_table,
              .units_by = over_units});
  course.add("values", &Course::values,
             {.meaning = "values at times or positions; linear between, held outside",
              .unit = unit,
              .required = true,
              .only = in_table,
              .units_by = units_by});
  add_table_file(course, in_table,
                 {{"time", "times"}, {"position", "positions"}, {"value", "values"}});
}

}  // namespace

Fields<Course> course_fields(const std::string& unit, const UnitsBy& units_by) {
  using enum CourseShape;
  Fields<Course> course;
  course.add("shape", &Course::shape, {});
  course.add("value", &Course::value,
             {.meaning = "final value",
              .unit = unit,
              .required = true,
              .only = only_where("shape", {ramp, smooth, constant}),
              .units_by = units_by});
  course.add("duration", &Course::duration,
             {.meaning = "time to full value",
              .unit = "s",
              .range = kPositive,
              .required = true,
              .only = only_where("shape", {ramp, smooth})});
  add_table(unit, units_by, course);
  course.add("period", &Course::period,
             {.meaning = "after which the course begins again, a table from its first entry on; "
                         "where it does not end as it begins it jumps; default: it goes once",
              .unit = "s|rad|m",
              .range = kPositive,
              .only = only_where("shape", {ramp, smooth, CourseShape::table}),
              .units_by = period_units});
  return course;
}

Fields<Load> load_fields() {
  using enum LoadKind;
  Fields<Load> load;
  load.add("name", &Load::name, {.type = name, .meaning = "name of the load", .required = true});
  load.read_word<LoadKind>("type", {.required = true}, read_type);
  add_place(load);
  load.table("course", &Load::course,
             {.meaning = "course over time, or over a joint coordinate",
              .required = true,
              .only = only_where("type", {torque, force, link_force, link_torque})},
             course_fields("N|N m", course_units), leave_unknown_course);
  load.table("law", &Load::law,
             {.meaning = "law of the resistance",
              .required = true,
              .only = only_where("type", {resistance})},
             law_fields());
  load.finish(require_fit);
  return load;
}

}  // namespace linkstudy
