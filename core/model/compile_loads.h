// Loads as the step loop has them, appended to a model.
#pragma once

#include "core/model/compile.h"

namespace linkstudy {

struct PlacedLoad {
  VelocityIndex v{};         // drive, resistance
  BodyIndex body{};          // link_force, link_torque
  PositionIndex over{};      // coordinate that its course goes by; none: time
  Vec3<double> point{};      // internal frame, m
  Vec3<double> direction{};  // internal frame where it follows the link, else ground axes
};

void add_load(const Load& load, const PlacedLoad& placed, Model& model);

}  // namespace linkstudy
