// The keys of kind = "model".
#include "study/config/model_keys.h"

#include "study/config/read_value.h"
#include "study/config/rotation_reader.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr const char* kInertiaMeaning =
    "inertia matrix about the centre of mass, axes of the link frame: xx yy zz, optionally xy xz "
    "yz (matrix entries, I_xy = -int x y dm)";

void read_inertia(Link& link, Tree& value, const Reading&) {
  std::array<double, 6> m{};
  for (std::size_t i = 0; i < value.items.size(); ++i) m[i] = value.items[i].as_number();
  link.inertia << m[0], m[3], m[4],  //
      m[3], m[1], m[5],              //
      m[4], m[5], m[2];
}

// Parallel axis: I_C = I_O - m (c.c E - c c^T).
void move_inertia(Link& link, Tree& table, const Reading&) {
  const Tree* at_origin = table.find("inertia_at_origin");
  if (at_origin == nullptr || !at_origin->is_valid()) return;
  const Vector3d& c = link.center_of_mass;
  link.inertia -= link.mass * (c.squaredNorm() * Matrix3d::Identity() - c * c.transpose());
  if (!are_known(table, {"mass", "center_of_mass"})) link.inertia = Matrix3d::Identity();
}

// Whether body and beam fit is a question only when both are what the user wrote.
void leave_unknown_beam(Link& link, Tree& table, const Reading&) {
  if (!link.flexible) return;
  const bool is_known =
      are_known(table, {"mass", "center_of_mass", "inertia", "inertia_at_origin"}) &&
      are_known(*table.find("flexible"), {"begin", "end", "across"});
  if (!is_known) link.flexible.reset();
}

Fields<Link> link_fields() {
  Fields<Link> link;
  link.add("name", &Link::name, {.type = name, .meaning = "name of the link", .required = true});
  link.add("mass", &Link::mass,
           {.meaning = "mass", .unit = "kg", .range = kPositive, .required = true});
  link.add("center_of_mass", &Link::center_of_mass,
           {.meaning = "centre of mass in the link frame", .unit = "m", .counts = {3}});
  const auto add_inertia = [&](const char* key, const char* meaning) {
    link.read(key,
              {.type = numbers,
               .meaning = meaning,
               .unit = "kg m^2",
               .required = true,
               .counts = {3, 6},
               .group = "inertia"},
              read_inertia);
  };
  add_inertia("inertia", kInertiaMeaning);
  add_inertia("inertia_at_origin", "the same about the origin of the link frame");
  link.switched_table(
      "flexible", &Link::flexible,
      {.meaning = "the link as a uniform beam of rigid finite elements; mass, centre and inertia "
                  "stay those of the link",
       .effects = {when_enabled("link.*.flexible")}},
      flexible_fields(), "false: rigid, whatever the table says");
  // Written beside what acts: it is no surprise that runs do not use it.
  const Effect in_reports{.key = "verb", .words = {"report"}, .stands_by = true};
  link.tables("shape", &Link::shape,
              {.meaning = "solids that the report draws the link as, in place of bars from joint "
                          "to joint; of no effect on the motion. Those of a flexible link bend "
                          "with it",
               .effects = {in_reports}},
              shape_fields());
  link.finish(move_inertia);
  link.finish(leave_unknown_beam);
  return link;
}

Fields<ChosenPoint> point_fields() {
  Fields<ChosenPoint> point;
  point.add("name", &ChosenPoint::name,
            {.type = name, .meaning = "name of the point", .required = true});
  point.add("link", &ChosenPoint::link,
            {.type = name, .meaning = "link it moves with, or ground", .required = true});
  point.add("position", &ChosenPoint::position,
            {.meaning = "place in the link frame", .unit = "m", .counts = {3}});
  return point;
}

Fields<Linkage> linkage_fields() {
  Fields<Linkage> linkage;
  linkage.add(
      "gravity", &Linkage::gravity,
      {.meaning = "acceleration of gravity in the ground frame", .unit = "m/s^2", .counts = {3}});
  linkage.tables("link", &Linkage::links,
                 {.meaning = "moving links; 'ground' exists", .required = true}, link_fields());
  linkage.tables("joint", &Linkage::joints,
                 {.meaning = "joints of the spanning tree", .required = true}, joint_fields());
  linkage.tables("closure", &Linkage::closures, {.meaning = "joints that shut loops"},
                 closure_fields());
  linkage.tables("load", &Linkage::loads, {.meaning = "drives, resistances and forces"},
                 load_fields());
  linkage.tables("motion", &Linkage::motions,
                 {.meaning = "coordinates that follow a law of time, whatever it takes: channels "
                             "motion.NAME.effort, power"},
                 motion_fields());
  linkage.tables("coupling", &Linkage::couplings,
                 {.meaning = "linear relations between coordinates, held exactly (gears, racks, "
                             "belts, differentials): channel coupling.NAME.effort"},
                 coupling_fields());
  linkage.tables("spring", &Linkage::springs,
                 {.meaning = "springs, dampers and actuators along the line between two points, "
                             "channels spring.NAME.length, rate, force"},
                 point_spring_fields());
  linkage.tables("point", &Linkage::points,
                 {.meaning = "points to watch, channels point.NAME.position, velocity, "
                             "acceleration; of no effect on the motion"},
                 point_fields());
  return linkage;
}

}  // namespace

Fields<Frame> rotation_fields(const Condition& only) {
  Fields<Frame> rotation;
  rotation.read("axis", {.type = numbers,
                         .meaning = "rotation axis in the link, of any length; goes with angle",
                         .required = true,
                         .counts = {3},
                         .group = "form"});
  rotation.read("angle", {.meaning = "angle about axis (right-hand rule)", .unit = "rad"});
  const auto add_forms = [](Fields<Frame>& to, const std::string& group, bool required,
                            const Condition& where) {
    to.read("matrix", {.type = matrix,
                       .meaning = "rotation as three rows; columns are the axes of the frame",
                       .required = required,
                       .group = group,
                       .only = where});
    to.read("euler_zyx", {.type = numbers,
                          .meaning = "rotation Rz(psi) Ry(theta) Rx(phi): psi, theta, phi",
                          .unit = "rad",
                          .required = required,
                          .counts = {3},
                          .group = group,
                          .only = where});
    to.read("quaternion", {.type = numbers,
                           .meaning = "rotation as a unit quaternion w, x, y, z",
                           .required = required,
                           .counts = {4},
                           .group = group,
                           .only = where});
  };
  add_forms(rotation, "form", true, {});
  Fields<Frame> frame;
  frame.table("rotation",
              {.meaning = "orientation of the frame in the link, in one of four ways",
               .standard = "{ quaternion = [1.0, 0.0, 0.0, 0.0] }",
               .group = "rotation",
               .only = only},
              std::move(rotation));
  add_forms(frame, "rotation", false, only);
  frame.finish(read_rotation);
  return frame;
}

Fields<Frame> frame_fields() {
  Fields<Frame> frame;
  frame.add("position", &Frame::position,
            {.meaning = "origin of the frame in the link", .unit = "m", .counts = {3}});
  frame.append(rotation_fields());
  return frame;
}

Fields<Friction> friction_fields() {
  Fields<Friction> law;
  law.add("mu_s", &Friction::mu_s,
          {.meaning = "static coefficient, not below mu_k", .range = kPositive, .required = true});
  law.add("mu_k", &Friction::mu_k,
          {.meaning = "kinetic coefficient", .range = kPositive, .required = true});
  law.add("stribeck_speed", &Friction::v_s,
          {.meaning = "v_s: the static part falls as exp(-(v / v_s)^2)",
           .unit = "m/s",
           .range = kPositive});
  law.add(
      "sigma0", &Friction::sigma0,
      {.meaning = "stiffness of the bristle", .unit = "1/m", .range = kPositive, .required = true});
  law.add("sigma1", &Friction::sigma1,
          {.meaning = "damping of the bristle", .unit = "s/m", .range = kNotNegative});
  law.add("sigma2", &Friction::sigma2,
          {.meaning = "viscous coefficient", .unit = "s/m", .range = kNotNegative});
  law.add("damping_speed", &Friction::v_d,
          {.meaning = "v_d: sigma1 is weighted by exp(-(v / v_d)^2); 0: not weighted",
           .unit = "m/s",
           .range = kNotNegative});
  return law;
}

std::vector<KeyRow> make_model_rows() {
  Fields<ModelInput> model;
  add_file_fields(model, "model");
  model.include(&ModelInput::linkage, linkage_fields());
  model.table("simulation", &ModelInput::options,
              {.meaning = "how a run is made", .standard = "{}"}, simulation_fields());
  model.table("kinematics", &ModelInput::kinematics,
              {.meaning = "course of `linkstudy kinematics`; of no effect on runs",
               .effects = {{"verb", {"kinematics"}, {}, false}}},
              kinematics_fields());
  return model.rows();
}

}  // namespace linkstudy
