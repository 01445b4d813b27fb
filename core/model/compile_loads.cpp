#include "core/model/compile_loads.h"

#include "core/model/piecewise.h"

namespace linkstudy {

void add_load(const Load& load, const PlacedLoad& placed, Model& model) {
  LoadStructure s{.type = load.type,
                  .v = placed.v,
                  .body = placed.body,
                  .follows_link = load.follows_link,
                  .law = load.law.shape};
  LoadParameters<double> p{};
  p.point = placed.point;
  p.direction = placed.direction;
  if (load.type == LoadType::resistance) {
    const bool linear = load.law.shape == ResistanceShape::linear;
    p.resistance = load.law.value / (load.law.at_speed * (linear ? 1.0 : load.law.at_speed));
  } else {
    p.course = add_course(load.course, placed.over, s.course, model.mechanism, model.parameters);
  }
  model.mechanism.loads.push_back(s);
  model.parameters.loads.push_back(p);
}

}  // namespace linkstudy
