// A point mass on a rail along ground z, held at the origin by an sde; no gravity. Natural
// frequency sqrt(c / m), damping ratio b / (2 sqrt(c m)); hung in gravity g it rests at -m g / c.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

Linkage mass_on_spring(double mass, double stiffness, double damping = 0.0);

}  // namespace linkstudy::testing
