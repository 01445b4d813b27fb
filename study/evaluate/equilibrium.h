// A static equilibrium by the names of channels.
#pragma once

#include <string>
#include <vector>

#include "core/simulation/prepare.h"
#include "study/config/model_reader.h"

namespace linkstudy {

// A quantity of the equilibrium by its name.
struct StaticValue {
  std::string name;
  double value;
  std::string unit;
};

// The model as statics takes it: started from its equilibrium and at rest. At rest nothing tells
// where a loose journal lies in its bearing: closures with clearance become ideal joints, and their
// names are returned.
std::vector<std::string> take_statics(ModelInput& input);

// Coordinates, reactions, holding efforts ("joint.P.hold", "joint.U.hold.1": along the coordinate,
// on the child), closures, springs and points.
std::vector<StaticValue> equilibrium_values(const Preparation& preparation,
                                            SimulationOptions options);

}  // namespace linkstudy
