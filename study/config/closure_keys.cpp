// The keys of frames and of [[closure]].
#include "study/config/model_keys.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Rows = std::vector<KeyRow>;

void add_cut_rows(Rows& rows) {
  const std::string cut = "closure.*.cut";
  rows.push_back(
      {.path = cut,
       .type = table,
       .meaning = "how exact constraints are held: of model cut, and those that clearance leaves",
       .standard = "{}",
       .effects = {stands_by("closure.*.model", {"cut", "clearance"})}});
  rows.push_back({.path = cut + ".stabilization",
                  .type = word,
                  .meaning = "how drift of the constraints is held down",
                  .standard = "\"none\"",
                  .words = {"none", "baumgarte", "projection"}});
  rows.push_back({.path = cut + ".alpha",
                  .type = number,
                  .meaning = "Baumgarte: -2 alpha Phi_dot",
                  .unit = "1/s",
                  .range = kNotNegative,
                  .standard = "100.0",
                  .effects = {acts_where(cut + ".stabilization", {"baumgarte"})}});
  rows.push_back({.path = cut + ".beta",
                  .type = number,
                  .meaning = "Baumgarte: -beta^2 Phi",
                  .unit = "1/s",
                  .range = kNotNegative,
                  .standard = "50.0",
                  .effects = {acts_where(cut + ".stabilization", {"baumgarte"})}});
}

// stiffness or damping: one number, or one for each direction.
void add_component_rows(Rows& rows, const std::string& path, const std::string& what,
                        const std::string& linear, const std::string& angular) {
  rows.push_back({.path = path + ".all",
                  .type = number,
                  .meaning = what + " of the blocked directions not named (rotations: times arm^2)",
                  .unit = linear,
                  .range = kNotNegative});
  for (const char* d : {"x", "y", "z"}) {
    rows.push_back({.path = path + "." + d,
                    .type = number,
                    .meaning = what + " along " + d + ", 0: free",
                    .unit = linear,
                    .range = kNotNegative});
  }
  const char* axes[] = {"x", "y", "z"};
  const char* angles[] = {"phi", "theta", "psi"};
  for (int i = 0; i < 3; ++i) {
    rows.push_back({.path = path + "." + angles[i],
                    .type = number,
                    .meaning = what + " about " + axes[i] + ", 0: free",
                    .unit = angular,
                    .range = kNotNegative});
  }
}

void add_sde_rows(Rows& rows) {
  const std::string sde = "closure.*.sde";
  rows.push_back({.path = sde,
                  .type = table,
                  .meaning = "settings of model sde",
                  .effects = {stands_by("closure.*.model", {"sde"})}});
  rows.push_back({.path = sde + ".form",
                  .type = word,
                  .meaning = "one element a direction; one along the line of centres; three along "
                             "`directions`",
                  .standard = "\"directional\"",
                  .words = {"directional", "line_of_centres", "three_springs"}});
  rows.push_back({.path = sde + ".axes",
                  .type = word,
                  .meaning = "frame in which x y z are fixed: ground or the first end; by default "
                             "first for prismatic, cylindrical and planar, else ground",
                  .words = {"ground", "first"}});
  rows.push_back(
      {.path = sde + ".tilt",
       .type = word,
       .meaning = "measure of turns. axis (tilt of the x axis, at any turn of the joint) and "
                  "linearized (joint turned up to 45 deg) take sines: alone about one axis the "
                  "moment is (k/2) sin 2 phi, at most k/2, with the energy k/2 sin^2 phi. angle "
                  "takes the rotation vector (x y z of first): moment k phi, energy k/2 phi^2 "
                  "up to half a turn, where it changes sign; for fixed, prismatic, spherical",
       .standard = "\"axis\"",
       .words = {"axis", "linearized", "angle"}});
  rows.push_back({.path = sde + ".start",
                  .type = word,
                  .meaning = "closed: a run begins with the stiff directions (stiffness above 0 "
                             "where the type blocks) shut and at rest; given: deflected and moving "
                             "as the joints say",
                  .standard = "\"closed\"",
                  .words = {"closed", "given"}});
  rows.push_back({.path = sde + ".stiffness",
                  .type = number_or_table,
                  .meaning =
                      "stiffness of the directions the closure type blocks (rotations: times "
                      "arm^2), or a table with a number for each direction",
                  .unit = "N/m",
                  .range = kPositive,
                  .required = true});
  add_component_rows(rows, sde + ".stiffness", "stiffness", "N/m", "N m/rad");
  rows.push_back({.path = sde + ".damping",
                  .type = number_or_table,
                  .meaning = "damping, given as stiffness is",
                  .unit = "N s/m",
                  .range = kNotNegative,
                  .standard = "0.0",
                  .group = "damping"});
  add_component_rows(rows, sde + ".damping", "damping", "N s/m", "N m s/rad");
  rows.push_back({.path = sde + ".damping_ratio",
                  .type = number,
                  .meaning = "zeta in damping = 2 zeta sqrt(stiffness m_eff), instead of damping",
                  .range = kNotNegative,
                  .group = "damping"});
  rows.push_back({.path = sde + ".directions",
                  .type = matrix,
                  .meaning = "form three_springs: directions of the elements, one a row, in `axes`",
                  .standard = "[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]",
                  .only = {"form", {"three_springs"}}});
  rows.push_back({.path = sde + ".arm",
                  .type = number,
                  .meaning = "length that turns one stiffness into rotational ones",
                  .unit = "m",
                  .range = kPositive,
                  .standard = "0.1"});
}

}  // namespace

void add_frame_rows(Rows& rows, const std::string& path) {
  const std::string r = path + ".rotation";
  rows.push_back({.path = path + ".position",
                  .type = numbers,
                  .meaning = "origin of the frame in the link",
                  .unit = "m",
                  .standard = "[0.0, 0.0, 0.0]",
                  .counts = {3}});
  rows.push_back({.path = r,
                  .type = table,
                  .meaning = "orientation of the frame in the link, in one of four ways",
                  .standard = "{ quaternion = [1.0, 0.0, 0.0, 0.0] }",
                  .group = "rotation"});
  const auto add_forms = [&rows](const std::string& at, const std::string& group, bool required) {
    rows.push_back({.path = at + ".matrix",
                    .type = matrix,
                    .meaning = "rotation as three rows; columns are the axes of the frame",
                    .required = required,
                    .group = group});
    rows.push_back({.path = at + ".euler_zyx",
                    .type = numbers,
                    .meaning = "rotation Rz(psi) Ry(theta) Rx(phi): psi, theta, phi",
                    .unit = "rad",
                    .required = required,
                    .counts = {3},
                    .group = group});
    rows.push_back({.path = at + ".quaternion",
                    .type = numbers,
                    .meaning = "rotation as a unit quaternion w, x, y, z",
                    .required = required,
                    .counts = {4},
                    .group = group});
  };
  rows.push_back({.path = r + ".axis",
                  .type = numbers,
                  .meaning = "rotation axis in the link, of any length; goes with angle",
                  .required = true,
                  .counts = {3},
                  .group = "form"});
  rows.push_back({.path = r + ".angle",
                  .type = number,
                  .meaning = "angle about axis (right-hand rule)",
                  .unit = "rad"});
  add_forms(r, "form", true);
  add_forms(path, "rotation", false);
}

void add_closure_rows(Rows& rows) {
  rows.push_back({.path = "closure", .type = tables, .meaning = "joints that shut loops"});
  rows.push_back(
      {.path = "closure.*.name", .type = name, .meaning = "name of the closure", .required = true});
  rows.push_back({.path = "closure.*.type",
                  .type = word,
                  .meaning = "kind of joint; axis (or normal of planar) along local x, not z as in "
                             "the tree; universal: x of first and y of second",
                  .required = true,
                  .words = {"spherical", "revolute", "universal", "prismatic", "cylindrical",
                            "planar", "fixed"}});
  for (const char* end : {"first", "second"}) {
    const std::string path = std::string("closure.*.") + end;
    rows.push_back({.path = path,
                    .type = table,
                    .meaning = std::string(end) + " end: a link and the closure frame in it",
                    .required = true});
    rows.push_back({.path = path + ".link",
                    .type = name,
                    .meaning = "link of this end, or ground",
                    .required = true});
    add_frame_rows(rows, path);
  }
  rows.push_back({.path = "closure.*.model",
                  .type = word,
                  .meaning = "cut: exact, by multipliers; sde: by a spring-damping element; "
                             "clearance: a journal in a wider bearing",
                  .standard = "\"cut\"",
                  .words = {"cut", "sde", "clearance"}});
  add_cut_rows(rows);
  add_sde_rows(rows);
  add_clearance_rows(rows);
}

}  // namespace linkstudy
