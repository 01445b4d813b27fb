// The keys of [[joint]].
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "study/config/joint_units.h"
#include "study/config/model_keys.h"
#include "study/config/read_value.h"
#include "study/config/rotation_reader.h"
#include "study/config/table_files.h"

namespace linkstudy {
namespace {

using enum KeyType;

// Of an array with an entry for each coordinate: its unit, and what it is where it is not written.
void follow_type(KeyRow& row, const char* key) {
  row.units_by = [key](const Tree&, const Tree& joint) {
    const JointKind kind = joint_kind_of(joint);
    return kind.is_known ? coordinate_units(kind, key) : std::vector<std::string>();
  };
  row.derive = [key](const Tree& joint) -> std::optional<Tree> {
    const JointKind kind = joint_kind_of(joint);
    if (!kind.is_known) return std::nullopt;
    if (std::string_view(key) == "position") return start_position(kind);
    const std::size_t count = coordinate_units(kind, key).size();
    return Tree::make_array(std::vector<Tree>(count, Tree::make_number(0.0)));
  };
}

KeyRow array_row(const char* key, KeyRow row) {
  follow_type(row, key);
  return row;
}

Fields<Joint> start_fields() {
  Fields<Joint> start;
  start.add("position", &Joint::position,
            array_row("position",
                      {.meaning = "start coordinates, possibly approximate, in the order of the "
                                  "type: revolute, screw: angle about z; prismatic: shift along z; "
                                  "cylindrical: angle about z, shift along z; universal: angle "
                                  "about z, angle about the new y; planar: shift along x, shift "
                                  "along y, angle about z; spherical: psi about z, theta about the "
                                  "new y, phi about the new x, or the quaternion w x y z; free: "
                                  "shifts along x, y, z, then as spherical; default: all zero",
                       .unit = "rad|m|1"}));
  start.add("velocity", &Joint::velocity,
            array_row("velocity",
                      {.meaning = "start velocities, the rates of the coordinates; of a quaternion "
                                  "the angular velocity in the axes of the child's joint frame "
                                  "(body frame), three numbers; default: all zero",
                       .unit = "rad/s|m/s"}));
  start.add("hold", &Joint::hold,
            {.meaning = "assembly keeps position and velocity of this joint, statics its position "
                        "(and reports what that takes); a run lets it go"});
  return start;
}

// Of the coordinate that the table of a spring names: its unit, or that of its effort.
std::vector<std::string> curve_units(const Tree& joint, bool is_effort) {
  const Tree* spring = joint.find("spring");
  const Tree* table = spring == nullptr ? nullptr : spring->find("table");
  const JointKind kind = joint_kind_of(joint);
  if (table == nullptr || !kind.is_known) return {};
  const std::vector<std::string> units = coordinate_units(kind, "rest");
  const auto index = static_cast<std::size_t>(number_of(*table, "coordinate", 0.0));
  if (index >= units.size()) return {};
  if (!is_effort) return {units[index]};
  return {units[index] == "rad" ? "N m" : "N"};
}

Fields<JointCurve> joint_curve_fields() {
  Fields<JointCurve> curve;
  curve.add("coordinate", &JointCurve::coordinate,
            {.meaning = "coordinate within the joint, from 0", .range = {.low = 0, .high = 5}});
  curve.add("positions", [](JointCurve & to) -> auto& { return to.curve.at; },
            {.meaning = "coordinates, increasing, two or more",
             .unit = "rad|m",
             .required = true,
             .units_by = [](const Tree&, const Tree& joint) { return curve_units(joint, false); }});
  curve.add("efforts", [](JointCurve & to) -> auto& { return to.curve.force; },
            {.meaning = "moments or forces at positions against the coordinate (generalised force "
                        "-effort); linear between, held outside",
             .unit = "N m|N",
             .required = true,
             .units_by = [](const Tree&, const Tree& joint) { return curve_units(joint, true); }});
  add_table_file(curve, {}, {{"position", "positions"}, {"effort", "efforts"}});
  return curve;
}

void leave_unknown_curve(Joint& joint, Tree& table, const Reading&) {
  if (!are_known(table, {"coordinate", "positions", "efforts"})) joint.spring_curve.reset();
}

Fields<Joint> spring_fields() {
  Fields<Joint> spring;
  spring.add("stiffness", &Joint::stiffness,
             array_row("stiffness", {.meaning = "c, one for each coordinate; default: all zero",
                                     .unit = "N/m|N m/rad",
                                     .range = kNotNegative}));
  spring.add("damping", &Joint::damping,
             array_row("damping", {.meaning = "b, one for each coordinate; default: all zero",
                                   .unit = "N s/m|N m s/rad",
                                   .range = kNotNegative}));
  spring.add("rest", &Joint::rest,
             array_row("rest", {.meaning = "coordinates without spring force; default: all zero",
                                .unit = "rad|m"}));
  spring.table("table", &Joint::spring_curve,
               {.meaning = "moment over angle or force over displacement of one coordinate, beside "
                           "stiffness; default: none"},
               joint_curve_fields(), leave_unknown_curve);
  return spring;
}

Fields<JointStops> stop_fields() {
  const auto array = [](const char* key, KeyRow row) {
    follow_type(row, key);
    row.derive = {};
    return row;
  };
  Fields<JointStops> stop;
  stop.add("low", &JointStops::low,
           array("rest", {.meaning = "lower ends, one for each coordinate; default: none",
                          .unit = "rad|m"}));
  stop.add("high", &JointStops::high,
           array("rest", {.meaning = "upper ends, one for each coordinate; default: none",
                          .unit = "rad|m"}));
  stop.add("stiffness", &JointStops::stiffness,
           {.meaning = "K, one for each coordinate, N/m^exponent or N m/rad^exponent; 0: the "
                       "coordinate has no stops",
            .range = kNotNegative,
            .required = true});
  const Effect of_impact{"joint.*.stop.damping", {}, {}, false};
  stop.add("exponent", &JointStops::exponent,
           {.meaning = "power n of the depth; 1 is a linear spring", .range = {.low = 1.0}});
  stop.add(
      "law", &JointStops::law,
      {.meaning = "D of the restitution, as contacts of closures have it", .effects = {of_impact}});
  stop.add("restitution", &JointStops::restitution,
           {.meaning = "coefficient of restitution of the law; 1 loses nothing",
            .range = {.low = 0.0, .high = 1.0, .low_is_out = true},
            .group = "damping"});
  stop.add("damping", &JointStops::damping,
           array("damping", {.meaning = "b of a force max(K d^n + b d', 0), one for each "
                                        "coordinate, in place of law and restitution",
                             .unit = "N s/m|N m s/rad",
                             .range = kNotNegative,
                             .group = "damping"}));
  stop.add("approach", &JointStops::approach,
           {.meaning = "approach speed of the law", .effects = {of_impact}});
  return stop;
}

Fields<JointFriction> joint_friction_fields() {
  Fields<JointFriction> friction;
  friction.include(&JointFriction::law, friction_fields());
  friction.add("load", &JointFriction::load, {.meaning = "what presses the surfaces together"});
  friction.add("radius", &JointFriction::radius,
               {.meaning = "radius of the sliding surface, not 0 where it turns; prismatic: arm of "
                           "the moment about the axis, 0: not felt; planar and free: 0: turns are "
                           "not braked",
                .unit = "m",
                .range = kNotNegative});
  friction.add("length", &JointFriction::length,
               {.meaning = "between the two supports along the axis; 0: moments load nothing",
                .unit = "m",
                .range = kNotNegative,
                .effects = {acts_where("joint.*.friction.load", {FrictionLoad::reaction})}});
  friction.add("preload", &JointFriction::preload,
               {.meaning = "normal load besides the reaction, or all of it",
                .unit = "N",
                .range = kNotNegative});
  return friction;
}

void leave_unknown_stop(Joint& joint, Tree& stop, const Reading&) {
  if (!are_known(stop, {"low", "high", "stiffness", "damping", "restitution", "exponent"})) {
    joint.stop.reset();
  }
}

// What the type decides is known with the type only.
void settle_coordinates(Joint& joint, Tree& table, const Reading& reading) {
  const JointKind kind = joint_kind_of(table);
  if (!kind.is_known) {
    for (auto* list :
         {&joint.position, &joint.velocity, &joint.stiffness, &joint.damping, &joint.rest}) {
      list->clear();
    }
    joint.stop.reset();
    joint.spring_curve.reset();
    return;
  }
  const auto count = static_cast<std::size_t>(position_count(joint.type, joint.coordinates));
  const bool has_quaternion =
      position_count(joint.type, joint.coordinates) != velocity_count(joint.type);
  if (!has_quaternion || joint.position.size() != count) return;
  Eigen::Map<Eigen::Vector4d> q(joint.position.data() + count - 4);
  if (std::abs(q.norm() - 1.0) <= kQuaternionTolerance) {
    q.normalize();
    return;
  }
  reading.report(*table.find("initial")->find("position"),
                 fmt::format("{}the quaternion in initial.position must have length 1, got length "
                             "{:.6g}",
                             subject_of(reading.scope), q.norm()),
                 "order w, x, y, z; divide by the length");
}

}  // namespace

Fields<Joint> joint_fields() {
  using Type = JointType;
  Fields<Joint> joint;
  joint.add("name", &Joint::name, {.type = name, .meaning = "name of the joint", .required = true});
  joint.add("type", &Joint::type,
            {.meaning = "kind of joint; it moves along or about local z",
             .required = true,
             .words = word_texts(std::span<const JointType>(kTreeJointTypes))});
  joint.add("coordinates", &Joint::coordinates,
            {.meaning = "coordinates of the rotation",
             .only = only_where("type", {Type::spherical, Type::free})});
  joint.add("parent", &Joint::parent,
            {.type = name, .meaning = "link the joint sits on, or ground", .required = true});
  joint.add("child", &Joint::child,
            {.type = name,
             .meaning = "link the joint carries; every link is carried by one joint",
             .required = true});
  joint.table("frame", &Joint::frame, {.meaning = "joint frame in the parent", .standard = "{}"},
              frame_fields());
  joint.table("child_frame", &Joint::child_frame,
              {.meaning = "joint frame in the child", .standard = "{}"}, frame_fields());
  joint.read("pitch",
             {.meaning = "advance of a screw joint in one revolution, not zero",
              .unit = "m/rev",
              .required = true,
              .only = only_where("type", {Type::screw})},
             [](Joint& to, Tree& value, const Reading&) {
               to.pitch = value.as_number() / (2.0 * std::numbers::pi);  // kept in m/rad
             });
  joint.table("initial", {.meaning = "start of the joint", .standard = "{}"}, start_fields());
  joint.table("spring",
              {.meaning = "spring and damper on every coordinate, force -c (q - rest) - b v; not "
                          "for quaternions; default: none"},
              spring_fields());
  joint.table("stop", &Joint::stop,
              {.meaning = "end stops, contacts where a coordinate is beyond low or high; channel "
                          "joint.NAME.stop.force; not for quaternions; default: none"},
              stop_fields(), leave_unknown_stop);
  joint.switched_table(
      "friction", &Joint::friction,
      {.meaning = "LuGre friction, mu = sigma0 z + sigma1 z' + sigma2 v, under the load that the "
                  "joint's own reaction makes, or a constant one; default: none",
       .only =
           only_where("type", {Type::revolute, Type::prismatic, Type::cylindrical, Type::universal,
                               Type::spherical, Type::planar, Type::free, Type::screw}),
       .effects = {when_enabled("joint.*.friction")}},
      joint_friction_fields(), "false: no friction, whatever the table says");
  joint.finish(settle_coordinates);
  return joint;
}

}  // namespace linkstudy
