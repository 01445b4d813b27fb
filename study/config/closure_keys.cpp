// The keys of [[closure]], without those of clearance.
#include <fmt/format.h>

#include "study/config/model_keys.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Components = std::array<double, kDirections>;

Fields<Closure> cut_fields() {
  const Effect of_baumgarte = acts_where("closure.*.cut.stabilization", {Stabilization::baumgarte});
  Fields<Closure> cut;
  cut.add("stabilization", &Closure::stabilization,
          {.meaning = "how drift of the constraints is held down"});
  cut.add("alpha", &Closure::alpha,
          {.meaning = "Baumgarte: -2 alpha Phi_dot",
           .unit = "1/s",
           .range = kNotNegative,
           .effects = {of_baumgarte}});
  cut.add("beta", &Closure::beta,
          {.meaning = "Baumgarte: -beta^2 Phi",
           .unit = "1/s",
           .range = kNotNegative,
           .effects = {of_baumgarte}});
  return cut;
}

// One number, or one for each direction.
void add_components(Fields<Sde>& sde, const std::string& key, const std::string& what,
                    const std::string& angular, KeyRow row) {
  Fields<Sde> components;
  components.read("all", {.meaning = what + " of the blocked directions not named (rotations: "
                                            "times arm^2)",
                          .unit = row.unit,
                          .range = kNotNegative});
  for (std::size_t d = 0; d < kDirections; ++d) {
    const bool turns = d >= kPhi;
    const std::string way = turns ? " about " : " along ";
    components.read(kDirectionNames[d],
                    {.meaning = what + way + kDirectionNames[d % 3] + ", 0: free",
                     .unit = turns ? angular : row.unit,
                     .range = kNotNegative});
  }
  row.type = number_or_table;
  sde.read(key, std::move(row));
  sde.append(std::move(components).under(key + "."));
}

bool slides(JointType type) {
  constexpr unsigned translations = 1u << kX | 1u << kY | 1u << kZ;
  return (blocked_directions(type) & translations) != translations;
}

// The axes that the free directions of the closure turn with, if it has any.
std::optional<Tree> choose_axes(const Tree& closure) {
  const JointType type =
      find_word<JointType>(word_of(closure, "type")).value_or(JointType::spherical);
  return Tree::make_text(std::string(name_of(slides(type) ? SdeAxes::first : SdeAxes::ground)));
}

void normalise_directions(Sde& sde, Tree&, const Reading&) {
  for (int i = 0; i < 3; ++i) {
    const double length = sde.directions.row(i).stableNorm();
    if (length > 0.0) sde.directions.row(i) /= length;
    if (!(length > 0.0)) sde.directions.row(i).setZero();
  }
}

Fields<Sde> sde_fields() {
  Fields<Sde> sde;
  sde.add("form", &Sde::form, {});
  sde.add("axes", &Sde::axes,
          {.meaning = "frame in which x y z are fixed; by default first for prismatic, cylindrical "
                      "and planar, else ground",
           .derive = choose_axes});
  sde.add("tilt", &Sde::tilt, {.meaning = "measure of turns"});
  sde.add("start", &Sde::start, {});
  add_components(sde, "stiffness", "stiffness", "N m/rad",
                 {.meaning = "stiffness of the directions the closure type blocks (rotations: "
                             "times arm^2), or a table with a number for each direction",
                  .unit = "N/m",
                  .range = kPositive,
                  .required = true});
  add_components(sde, "damping", "damping", "N m s/rad",
                 {.meaning = "damping, given as stiffness is",
                  .unit = "N s/m",
                  .range = kNotNegative,
                  .standard = "0.0",
                  .group = "damping"});
  sde.add("damping_ratio", &Sde::damping_ratio,
          {.meaning = "zeta in damping = 2 zeta sqrt(stiffness m_eff), instead of damping",
           .range = kNotNegative,
           .group = "damping"});
  sde.add("directions", &Sde::directions,
          {.meaning = "form three_springs: directions of the elements, one a row, in `axes`",
           .only = only_where("form", {SdeForm::three_springs})},
          normalise_directions);
  sde.read("arm", {.meaning = "length that turns one stiffness into rotational ones",
                   .unit = "m",
                   .range = kPositive,
                   .standard = "0.1"});
  return sde;
}

Components spread(double value, JointType type, double arm) {
  Components components{};
  const unsigned blocked = blocked_directions(type);
  for (unsigned d = 0; d < kDirections; ++d) {
    if ((blocked >> d & 1u) == 0) continue;
    components[d] = d < kPhi ? value : value * arm * arm;
  }
  return components;
}

Components components_of(const Tree* tree, JointType type, double arm) {
  if (tree == nullptr || !tree->is_valid()) return {};
  if (tree->is_numeric()) return spread(tree->as_number(), type, arm);
  Components components = spread(number_of(*tree, "all", 0.0), type, arm);
  for (std::size_t d = 0; d < kDirections; ++d) {
    components[d] = number_of(*tree, kDirectionNames[d], components[d]);
  }
  return components;
}

// The type of the closure says which directions one number is for.
void spread_components(Closure& closure, Tree& table, const Reading&) {
  const Tree* sde = table.find("sde");
  if (sde == nullptr || !sde->is(Tree::Kind::table)) return;
  const double arm = number_of(*sde, "arm", 1.0);
  closure.sde.stiffness = components_of(sde->find("stiffness"), closure.type, arm);
  closure.sde.damping = components_of(sde->find("damping"), closure.type, arm);
}

// A model without its table: one report, and a mark that keeps others away.
void require_table(const Closure& closure, Tree& table, const Reading& reading, const char* key,
                   const char* needs, const char* remedy) {
  if (table.find(key) != nullptr) return;
  if (*needs != 0) {
    reading.diagnostics.add(table.find("model")->at,
                            fmt::format("closure '{}': model = '{}' needs {}", closure.name,
                                        name_of(closure.model), needs),
                            remedy);
  }
  Tree reported;
  reported.at = table.at;
  table.set(key, std::move(reported));
}

// Another type than revolute has no clearance at all: the checks of the core say so.
void require_settings(Closure& closure, Tree& table, const Reading& reading) {
  if (closure.model == ClosureModel::sde) {
    require_table(closure, table, reading, "sde", "the key sde.stiffness",
                  "add sde = { stiffness = 1.0e6, damping_ratio = 0.7 }");
  }
  if (closure.model == ClosureModel::clearance) {
    const bool is_revolute = closure.type == JointType::revolute;
    require_table(closure, table, reading, "clearance",
                  is_revolute ? "the keys clearance.radial and clearance.bearing_radius" : "",
                  "add clearance = { radial = \"1 mm\", bearing_radius = \"5 mm\" }");
  }
}

// The defaults of a contact that is not written, filled in where there is a clearance.
std::optional<Tree> contact_of_clearance(const Tree& closure) {
  const Tree* clearance = closure.find("clearance");
  const bool is_written = clearance != nullptr && clearance->is(Tree::Kind::table);
  return is_written ? std::optional(Tree::make_table()) : std::nullopt;
}

Fields<ClosureEnd> end_fields() {
  Fields<ClosureEnd> end;
  end.add("link", &ClosureEnd::link,
          {.type = name, .meaning = "link of this end, or ground", .required = true});
  end.include(&ClosureEnd::frame, frame_fields());
  return end;
}

void add_clearance_tables(Fields<Closure>& closure) {
  const Effect of_clearance =
      acts_where("closure.*.model", {ClosureModel::clearance}, "closure.*.clearance");
  closure.table("clearance", &Closure::clearance,
                {.meaning = "settings of model clearance, for revolute closures; constraints that "
                            "remain are held as `cut` says",
                 .effects = {stands_by("closure.*.model", {ClosureModel::clearance})}},
                clearance_fields());
  closure.table("contact", &Closure::clearance,
                {.meaning = "normal force of model clearance, K depth^exponent (1 + D rate / "
                            "approach speed); default: steel on steel",
                 .effects = {of_clearance},
                 .derive = contact_of_clearance},
                contact_fields());
  closure.switched_table(
      "friction", [](Closure& c) -> std::optional<Friction>& { return c.clearance.friction; },
      {.meaning = "LuGre friction of model clearance, mu = sigma0 z + sigma1 z' + sigma2 v; "
                  "default: none",
       .effects = {of_clearance, when_enabled("closure.*.friction")}},
      friction_fields(), "false: no friction, whatever the table says");
}

}  // namespace

Fields<Closure> closure_fields() {
  Fields<Closure> closure;
  closure.add("name", &Closure::name,
              {.type = name, .meaning = "name of the closure", .required = true});
  closure.add("type", &Closure::type,
              {.meaning = "kind of joint; axis (or normal of planar) along local x, not z as in "
                          "the tree; universal: x of first and y of second",
               .required = true,
               .words = word_texts(std::span<const JointType>(kClosureTypes))});
  closure.add("length", &Closure::length,
              {.meaning = "of a rod: distance between the points of its ends",
               .unit = "m",
               .range = kPositive,
               .required = true,
               .only = only_where("type", {JointType::rod})});
  closure.table("first", &Closure::first,
                {.meaning = "first end: a link and the closure frame in it", .required = true},
                end_fields());
  closure.table("second", &Closure::second,
                {.meaning = "second end: a link and the closure frame in it", .required = true},
                end_fields());
  closure.add("model", &Closure::model, {});
  closure.table(
      "cut",
      {.meaning = "how exact constraints are held: of model cut, and those that clearance leaves",
       .standard = "{}",
       .effects = {stands_by("closure.*.model", {ClosureModel::cut, ClosureModel::clearance})}},
      cut_fields());
  closure.table("sde", &Closure::sde,
                {.meaning = "settings of model sde",
                 .effects = {stands_by("closure.*.model", {ClosureModel::sde})}},
                sde_fields());
  add_clearance_tables(closure);
  closure.finish(spread_components);
  closure.finish(require_settings);
  return closure;
}

}  // namespace linkstudy
