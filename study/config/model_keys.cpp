// The keys of kind = "model".
#include "study/config/model_keys.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Rows = std::vector<KeyRow>;

Effect of_own_steps() {
  return acts_where("simulation.integrator", {"adaptive", "stiff"});
}

void add_gravity_row(Rows& rows) {
  rows.push_back({.path = "gravity",
                  .type = numbers,
                  .meaning = "acceleration of gravity in the ground frame",
                  .unit = "m/s^2",
                  .standard = "[0.0, 0.0, 0.0]",
                  .counts = {3}});
}

void add_link_rows(Rows& rows) {
  rows.push_back({.path = "link",
                  .type = tables,
                  .meaning = "moving links; 'ground' exists",
                  .required = true});
  rows.push_back(
      {.path = "link.*.name", .type = name, .meaning = "name of the link", .required = true});
  rows.push_back({.path = "link.*.mass",
                  .type = number,
                  .meaning = "mass",
                  .unit = "kg",
                  .range = kPositive,
                  .required = true});
  rows.push_back({.path = "link.*.center_of_mass",
                  .type = numbers,
                  .meaning = "centre of mass in the link frame",
                  .unit = "m",
                  .standard = "[0.0, 0.0, 0.0]",
                  .counts = {3}});
  rows.push_back({.path = "link.*.inertia",
                  .type = numbers,
                  .meaning = "inertia matrix about the centre of mass, axes of the link frame: "
                             "xx yy zz, optionally xy xz yz (matrix entries, I_xy = -int x y dm)",
                  .unit = "kg m^2",
                  .required = true,
                  .counts = {3, 6},
                  .group = "inertia"});
  rows.push_back({.path = "link.*.inertia_at_origin",
                  .type = numbers,
                  .meaning = "the same about the origin of the link frame",
                  .unit = "kg m^2",
                  .required = true,
                  .counts = {3, 6},
                  .group = "inertia"});
  add_flexible_rows(rows);
}

void add_spring_rows(Rows& rows) {
  const std::string spring = "joint.*.spring";
  const auto add = [&](const char* key, const char* meaning, const char* unit, Range range) {
    rows.push_back({.path = spring + "." + key,
                    .type = numbers,
                    .meaning = std::string(meaning) + "; default: all zero",
                    .unit = unit,
                    .range = range});
  };
  rows.push_back({.path = spring,
                  .type = table,
                  .meaning = "spring and damper on every coordinate, force -c (q - rest) - b v; "
                             "not for quaternions; default: none"});
  add("stiffness", "c, one for each coordinate", "N/m|N m/rad", kNotNegative);
  add("damping", "b, one for each coordinate", "N s/m|N m s/rad", kNotNegative);
  add("rest", "coordinates without spring force", "rad|m", {});
}

void add_joint_friction_rows(Rows& rows) {
  const std::string friction = "joint.*.friction";
  const auto add = [&](const char* key, const char* meaning, const char* unit) {
    rows.push_back({.path = friction + "." + key,
                    .type = number,
                    .meaning = meaning,
                    .unit = unit,
                    .range = kNotNegative,
                    .standard = "0.0"});
  };
  rows.push_back({.path = friction,
                  .type = table,
                  .meaning = "LuGre friction, mu = sigma0 z + sigma1 z' + sigma2 v, under the "
                             "load that the joint's own reaction makes; default: none",
                  .only = {"type", {"revolute", "prismatic", "cylindrical"}},
                  .effects = {when_enabled(friction)}});
  add_friction_rows(rows, friction);
  add("radius",
      "radius of the sliding surface, not 0 where it turns; prismatic: arm of the moment about the "
      "axis, 0: not felt",
      "m");
  add("length", "between the two supports along the axis; 0: moments load nothing", "m");
  add("preload", "normal load besides the reaction", "N");
}

void add_start_rows(Rows& rows) {
  rows.push_back({.path = "joint.*.initial",
                  .type = table,
                  .meaning = "start of the joint",
                  .standard = "{}"});
  rows.push_back({.path = "joint.*.initial.position",
                  .type = numbers,
                  .meaning = "start coordinates, possibly approximate, in the order of the type: "
                             "revolute, screw: angle about z; prismatic: shift along z; "
                             "cylindrical: angle about z, shift along z; universal: angle about z, "
                             "angle about the new y; planar: shift along x, shift along y, angle "
                             "about z; spherical: psi about z, theta about the new y, phi about "
                             "the new x, or the quaternion w x y z; free: shifts along x, y, z, "
                             "then as spherical; default: all zero",
                  .unit = "rad|m|1"});
  rows.push_back({.path = "joint.*.initial.velocity",
                  .type = numbers,
                  .meaning = "start velocities, the rates of the coordinates; of a quaternion the "
                             "angular velocity in the axes of the child's joint frame (body "
                             "frame), three numbers; default: all zero",
                  .unit = "rad/s|m/s"});
  rows.push_back({.path = "joint.*.initial.hold",
                  .type = boolean,
                  .meaning = "assembly keeps position and velocity of this joint, statics its "
                             "position (and reports what that takes); a run lets it go",
                  .standard = "false"});
}

void add_joint_rows(Rows& rows) {
  rows.push_back({.path = "joint",
                  .type = tables,
                  .meaning = "joints of the spanning tree",
                  .required = true});
  rows.push_back(
      {.path = "joint.*.name", .type = name, .meaning = "name of the joint", .required = true});
  rows.push_back({.path = "joint.*.type",
                  .type = word,
                  .meaning = "kind of joint; it moves along or about local z",
                  .required = true,
                  .words = {"revolute", "prismatic", "cylindrical", "universal", "spherical",
                            "planar", "free", "fixed", "screw"}});
  rows.push_back({.path = "joint.*.coordinates",
                  .type = word,
                  .meaning = "coordinates of the rotation: angles psi theta phi, or w x y z",
                  .standard = "\"zyx\"",
                  .words = {"zyx", "quaternion"},
                  .only = {"type", {"spherical", "free"}}});
  rows.push_back({.path = "joint.*.parent",
                  .type = name,
                  .meaning = "link the joint sits on, or ground",
                  .required = true});
  rows.push_back({.path = "joint.*.child",
                  .type = name,
                  .meaning = "link the joint carries; every link is carried by one joint",
                  .required = true});
  rows.push_back({.path = "joint.*.frame",
                  .type = table,
                  .meaning = "joint frame in the parent",
                  .standard = "{}"});
  add_frame_rows(rows, "joint.*.frame");
  rows.push_back({.path = "joint.*.child_frame",
                  .type = table,
                  .meaning = "joint frame in the child",
                  .standard = "{}"});
  add_frame_rows(rows, "joint.*.child_frame");
  rows.push_back({.path = "joint.*.pitch",
                  .type = number,
                  .meaning = "advance of a screw joint in one revolution, not zero",
                  .unit = "m/rev",
                  .required = true,
                  .only = {"type", {"screw"}}});
  add_start_rows(rows);
  add_spring_rows(rows);
  add_joint_friction_rows(rows);
}

void add_course_rows(Rows& rows) {
  const std::vector<std::string> driven = {"torque", "force", "link_force", "link_torque"};
  const std::string course = "load.*.course";
  rows.push_back({.path = course,
                  .type = table,
                  .meaning = "course over time",
                  .required = true,
                  .only = {"type", driven}});
  rows.push_back({.path = course + ".shape",
                  .type = word,
                  .meaning = "ramp: min(t/duration, 1); smooth: 3 s^2 - 2 s^3; constant; table",
                  .standard = "\"ramp\"",
                  .words = {"ramp", "smooth", "constant", "table"}});
  rows.push_back({.path = course + ".value",
                  .type = number,
                  .meaning = "final value",
                  .unit = "N|N m",
                  .required = true,
                  .only = {"shape", {"ramp", "smooth", "constant"}}});
  rows.push_back({.path = course + ".duration",
                  .type = number,
                  .meaning = "time to full value",
                  .unit = "s",
                  .range = kPositive,
                  .required = true,
                  .only = {"shape", {"ramp", "smooth"}}});
  rows.push_back({.path = course + ".times",
                  .type = numbers,
                  .meaning = "times, increasing",
                  .unit = "s",
                  .required = true,
                  .only = {"shape", {"table"}}});
  rows.push_back({.path = course + ".values",
                  .type = numbers,
                  .meaning = "values at times; linear between, held outside",
                  .unit = "N|N m",
                  .required = true,
                  .only = {"shape", {"table"}}});
}

void add_law_rows(Rows& rows) {
  const std::string law = "load.*.law";
  rows.push_back({.path = law,
                  .type = table,
                  .meaning = "law of the resistance",
                  .required = true,
                  .only = {"type", {"resistance"}}});
  rows.push_back({.path = law + ".shape",
                  .type = word,
                  .meaning = "linear: value v/at_speed; quadratic: value v|v|/at_speed^2",
                  .standard = "\"linear\"",
                  .words = {"linear", "quadratic"}});
  rows.push_back({.path = law + ".value",
                  .type = number,
                  .meaning = "resistance at at_speed",
                  .unit = "N|N m",
                  .required = true});
  rows.push_back({.path = law + ".at_speed",
                  .type = number,
                  .meaning = "speed of `value`",
                  .unit = "rad/s|m/s",
                  .range = kPositive,
                  .required = true});
}

void add_load_rows(Rows& rows) {
  const std::vector<std::string> on_joint = {"torque", "force", "resistance"};
  const std::vector<std::string> on_link = {"link_force", "link_torque"};
  rows.push_back({.path = "load", .type = tables, .meaning = "drives, resistances and forces"});
  rows.push_back(
      {.path = "load.*.name", .type = name, .meaning = "name of the load", .required = true});
  rows.push_back({.path = "load.*.type",
                  .type = word,
                  .meaning =
                      "torque, force: on a joint coordinate; resistance: against its motion; "
                      "link_force, link_torque: on a link",
                  .required = true,
                  .words = {"torque", "force", "resistance", "link_force", "link_torque"}});
  rows.push_back({.path = "load.*.joint",
                  .type = name,
                  .meaning = "joint it acts on",
                  .required = true,
                  .only = {"type", on_joint}});
  rows.push_back({.path = "load.*.coordinate",
                  .type = integer,
                  .meaning = "velocity coordinate within the joint, from 0",
                  .range = {.low = 0, .high = 5},
                  .standard = "0",
                  .only = {"type", on_joint}});
  rows.push_back({.path = "load.*.link",
                  .type = name,
                  .meaning = "link it acts on",
                  .required = true,
                  .only = {"type", on_link}});
  rows.push_back({.path = "load.*.point",
                  .type = numbers,
                  .meaning = "point of application in the link frame",
                  .unit = "m",
                  .standard = "[0.0, 0.0, 0.0]",
                  .counts = {3},
                  .only = {"type", {"link_force"}}});
  rows.push_back({.path = "load.*.direction",
                  .type = numbers,
                  .meaning = "direction, of any length",
                  .required = true,
                  .counts = {3},
                  .only = {"type", on_link}});
  rows.push_back({.path = "load.*.axes",
                  .type = word,
                  .meaning = "frame of direction",
                  .standard = "\"ground\"",
                  .words = {"ground", "link"},
                  .only = {"type", on_link}});
  add_course_rows(rows);
  add_law_rows(rows);
}

void add_point_rows(Rows& rows) {
  rows.push_back({.path = "point",
                  .type = tables,
                  .meaning = "points to watch, channels point.NAME.position, velocity, "
                             "acceleration; of no effect on the motion"});
  rows.push_back(
      {.path = "point.*.name", .type = name, .meaning = "name of the point", .required = true});
  rows.push_back({.path = "point.*.link",
                  .type = name,
                  .meaning = "link it moves with, or ground",
                  .required = true});
  rows.push_back({.path = "point.*.position",
                  .type = numbers,
                  .meaning = "place in the link frame",
                  .unit = "m",
                  .standard = "[0.0, 0.0, 0.0]",
                  .counts = {3}});
}

void add_tolerance_rows(Rows& rows) {
  const std::string tolerance = "simulation.tolerance";
  const auto add = [&](const char* key, const char* meaning, const char* standard) {
    rows.push_back({.path = tolerance + "." + key,
                    .type = number,
                    .meaning = meaning,
                    .range = kPositive,
                    .standard = standard});
  };
  rows.push_back({.path = tolerance,
                  .type = table,
                  .meaning = "error allowed in a step of adaptive and stiff",
                  .standard = "{}",
                  .effects = {of_own_steps()}});
  add("relative", "part of the size of each unknown", "1.0e-8");
  add("absolute", "in the unit of each unknown", "1.0e-10");
  rows.push_back({.path = "simulation.step_limit",
                  .type = integer,
                  .meaning = "adaptive, stiff: more steps end the run",
                  .range = {.low = 1},
                  .standard = "100000000",
                  .effects = {of_own_steps()}});
}

void add_simulation_rows(Rows& rows) {
  const std::string s = "simulation";
  rows.push_back({.path = s, .type = table, .meaning = "how a run is made", .standard = "{}"});
  rows.push_back({.path = s + ".end_time",
                  .type = number,
                  .meaning = "end of the run",
                  .unit = "s",
                  .range = kPositive,
                  .standard = "1.0"});
  rows.push_back({.path = s + ".step",
                  .type = number,
                  .meaning = "time step; the run takes ceil(end_time / step) equal steps; "
                             "adaptive and stiff: the grid on which a run is seen",
                  .unit = "s",
                  .range = kPositive,
                  .standard = "1.0e-4"});
  rows.push_back({.path = s + ".integrator",
                  .type = word,
                  .meaning = "rk4: classic Runge-Kutta with a constant step; adaptive: explicit "
                             "Dormand-Prince; stiff: implicit Rosenbrock; both find begin and end "
                             "of contacts",
                  .standard = "\"rk4\"",
                  .words = {"rk4", "adaptive", "stiff"}});
  add_tolerance_rows(rows);
  rows.push_back({.path = s + ".start",
                  .type = word,
                  .meaning = "given: as the joints say; equilibrium: statics first (joints with "
                             "hold = true stay; friction is left out)",
                  .standard = "\"given\"",
                  .words = {"given", "equilibrium"}});
  rows.push_back({.path = s + ".statics_time",
                  .type = number,
                  .meaning = "start = \"equilibrium\" and the verb statics: loads count with their "
                             "value at this time; a run begins at t = 0 all the same",
                  .unit = "s",
                  .range = kNotNegative,
                  .standard = "0.0"});
  rows.push_back({.path = s + ".redundant_reactions",
                  .type = word,
                  .meaning =
                      "reactions where joints hold a motion twice and single ones are not "
                      "unique; cut: multipliers of least norm in the cut joints, tree joints "
                      "bear the rest; loops: least over all joints of the loops; the motion "
                      "is the same but for friction in joints, which feels them",
                  .standard = "\"cut\"",
                  .words = {"cut", "loops"},
                  .effects = {acts_where("closure.*.model", {"cut", "clearance"})}});
  rows.push_back({.path = s + ".output_interval",
                  .type = number,
                  .meaning = "time between samples of channels",
                  .unit = "s",
                  .range = kPositive,
                  .standard = "1.0e-2"});
  rows.push_back({.path = s + ".drift_limit",
                  .type = number,
                  .meaning = "a larger gap (m or rad) of a cut closure ends the run",
                  .range = kPositive,
                  .standard = "1.0e-3",
                  .effects = {acts_where("closure.*.model", {"cut", "clearance"})}});
}

}  // namespace

void add_file_rows(Rows& rows, const std::string& kind) {
  rows.push_back({.path = "format",
                  .type = integer,
                  .meaning = "version of the input format: 1",
                  .range = {.low = 1, .high = 1},
                  .required = true});
  rows.push_back({.path = "kind",
                  .type = word,
                  .meaning = "what the file describes",
                  .required = true,
                  .words = {kind}});
  rows.push_back({.path = "name",
                  .type = text,
                  .meaning = "title in tables and plots",
                  .standard = "\"unnamed\""});
}

const std::vector<KeyRow>& model_rows() {
  static const Rows rows = [] {
    Rows all;
    add_file_rows(all, "model");
    add_gravity_row(all);
    add_link_rows(all);
    add_joint_rows(all);
    add_closure_rows(all);
    add_load_rows(all);
    add_point_rows(all);
    add_simulation_rows(all);
    add_kinematics_rows(all);
    return all;
  }();
  return rows;
}

}  // namespace linkstudy
