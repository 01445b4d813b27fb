// A planar slider-crank whose links are free to leave the plane: crank on a cylindrical joint A
// about z, rod on a spherical joint B (zyx), slider on a rail P along x, and a loose pin R about z
// between rod and slider, bearing on the slider. No row of R is redundant, planar or spatial.
// Lengths and masses of Flores and Ambrosio's slider-crank (2004): crank 0.05 m, 0.3 kg; rod
// 0.12 m, 0.21 kg; slider 0.14 kg. It starts stretched, with the crank turning freely.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

Linkage loose_slider_crank(ClearanceKind kind, double crank_speed);

}  // namespace linkstudy::testing
