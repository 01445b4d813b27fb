#include "study/config/clearance_reader.h"

#include <fmt/format.h>

#include "study/config/friction_reader.h"
#include "study/config/key.h"
#include "study/config/read_value.h"
#include "study/config/validate.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

// model = "clearance" without its table: one report, and a mark that keeps others away. Another
// type than revolute has no clearance at all: the checks of the core say so.
void report_missing(Tree& closure_table, const Closure& closure, Diagnostics& diagnostics) {
  if (closure.type == JointType::revolute) {
    diagnostics.add(
        closure_table.find("model")->at,
        fmt::format("closure '{}': model = 'clearance' needs the keys clearance.radial and "
                    "clearance.bearing_radius",
                    closure.name),
        "add clearance = { radial = \"1 mm\", bearing_radius = \"5 mm\" }");
  }
  Tree reported;
  reported.at = closure_table.at;
  closure_table.set("clearance", std::move(reported));
}

// The defaults of a contact that is not written, filled in where there is a clearance.
void add_contact(Tree& closure_table, const Location& at) {
  if (closure_table.find("contact") != nullptr) return;
  Tree& contact = closure_table.set("contact", Tree::make_table(at));
  Diagnostics none;
  validate(contact, *model_schema().find("closure")->element()->find("contact"), none);
}

ContactLaw law_of(const std::string& word) {
  if (word == "flores") return ContactLaw::flores;
  return word == "hunt_crossley" ? ContactLaw::hunt_crossley : ContactLaw::lankarani_nikravesh;
}

Material read_material(const Tree& contact, const char* body) {
  Material material;
  const Tree* table = contact.find(body);
  if (table == nullptr) return material;
  material.young = number_of(*table, "young", material.young);
  material.poisson = number_of(*table, "poisson", material.poisson);
  return material;
}

void read_contact(const Tree& contact, Clearance& clearance) {
  clearance.law = law_of(word_of(contact, "law"));
  clearance.restitution = number_of(contact, "restitution", clearance.restitution);
  clearance.exponent = number_of(contact, "exponent", clearance.exponent);
  const Tree* stiffness = contact.find("stiffness");
  if (stiffness != nullptr) clearance.stiffness = number_of(contact, "stiffness", 1.0);
  clearance.bearing = read_material(contact, "bearing");
  clearance.journal = read_material(contact, "journal");
  clearance.least_speed = number_of(contact, "least_speed", clearance.least_speed);
  if (word_of(contact, "approach") == "greatest") clearance.approach = ApproachSpeed::greatest;
  if (word_of(contact, "points") == "two") clearance.points = ContactPoints::two;
  const std::string bristle = word_of(contact, "free_bristle");
  if (bristle == "relax") clearance.free_bristle = FreeBristle::relax;
  if (bristle == "hold") clearance.free_bristle = FreeBristle::hold;
}

}  // namespace

void read_clearance(Tree& closure_table, Closure& closure, Diagnostics& diagnostics) {
  Clearance& clearance = closure.clearance;
  Tree* tree = closure_table.find("clearance");
  if (tree == nullptr && closure.model == ClosureModel::clearance) {
    return report_missing(closure_table, closure, diagnostics);
  }
  if (tree != nullptr && tree->is(Kind::table)) {
    if (word_of(*tree, "kind") == "spatial") clearance.kind = ClearanceKind::spatial;
    clearance.bearing_is_first = word_of(*tree, "bearing") == "first";
    clearance.radial = number_of(*tree, "radial", 0.0);
    clearance.bearing_radius = number_of(*tree, "bearing_radius", 0.0);
    clearance.length = number_of(*tree, "length", 0.0);
    add_contact(closure_table, Location(tree->at));
  }
  Tree* contact = closure_table.find("contact");
  if (contact != nullptr && contact->is(Kind::table)) {
    read_contact(*contact, clearance);
  }
  const Tree* friction = closure_table.find("friction");
  if (friction != nullptr && friction->is(Kind::table)) {
    clearance.friction = read_friction(*friction);
  }
}

}  // namespace linkstudy
