// Loads as the step loop has them, appended to a model.
#pragma once

#include "core/model/compile.h"

namespace linkstudy {

struct PlacedLoad {
  int v = -1;                // velocity index: drive, resistance
  int body = -1;             // link_force, link_torque
  int over = -1;             // index of the coordinate that its course goes by; -1: time
  Vec3<double> point{};      // internal frame, m
  Vec3<double> direction{};  // internal frame where it follows the link, else ground axes
};

void add_load(const Load& load, const PlacedLoad& placed, Model& model);

}  // namespace linkstudy
