// The keys of [[coupling]].
#include "study/config/joint_units.h"
#include "study/config/model_keys.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using enum KeyType;

// "rad" or "m" of the first term.
std::vector<std::string> offset_units(const Tree& document, const Tree& coupling) {
  const Tree* terms = coupling.find("terms");
  if (terms == nullptr || !terms->is(Tree::Kind::array) || terms->items.empty()) return {};
  const Tree& first = terms->items.front();
  const std::optional<std::string> unit =
      position_unit(document, word_of(first, "joint"), integer_of(first, "coordinate", 0));
  return unit && *unit != "1" ? std::vector<std::string>{*unit} : std::vector<std::string>();
}

Fields<CouplingTerm> term_fields() {
  Fields<CouplingTerm> term;
  term.add("joint", &CouplingTerm::joint,
           {.type = name, .meaning = "joint of the tree", .required = true});
  term.add("coordinate", &CouplingTerm::coordinate,
           {.meaning = "coordinate within the joint, from 0; none of a quaternion",
            .range = {.low = 0, .high = 5}});
  term.add("factor", &CouplingTerm::factor,
           {.meaning = "in SI, not zero: beside a slide the radius of a pinion in m, with the sign "
                       "of its sense"});
  return term;
}

}  // namespace

Fields<Coupling> coupling_fields() {
  Fields<Coupling> coupling;
  coupling.add("name", &Coupling::name,
               {.type = name, .meaning = "name of the coupling", .required = true});
  coupling.tables("terms", &Coupling::terms,
                  {.meaning = "sum of factor * coordinate = offset; two or more", .required = true},
                  term_fields());
  coupling.add("offset", &Coupling::offset,
               {.meaning = "in the unit of the first term; default: as the joints are described to "
                           "start",
                .unit = "rad|m",
                .units_by = offset_units});
  return coupling;
}

}  // namespace linkstudy
