// Spatial rigid slider-crank of Haug (IFToMM benchmark; numbers in physics.md section 9): crank
// about ground x through (0, 0.1, 0.12), spherical joint at its tip, rod, universal joint at the
// slider, slider on the ground's x axis, gravity -z. Crank angle 0 is vertical, start 6 rad/s.
// Closed form: tip (0, y, z) with y = 0.1 - a sin(psi), z = 0.12 + a cos(psi), x^2 = l^2 - y^2 -
// z^2; the rod's local x points from the slider to the tip, universal angles atan2(z, y), asin(x /
// l).
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct SpatialSliderCrankGeometry {
  double crank = 0.08, rod = 0.3;  // m
  double pivot_y = 0.1, pivot_z = 0.12;
};

struct SpatialSliderCrankPose {
  double psi, x, first, second;  // crank, slider, universal angles
  double psi_rate, x_rate, first_rate, second_rate;
};
SpatialSliderCrankPose spatial_slider_crank_pose(double psi, double psi_rate,
                                                 const SpatialSliderCrankGeometry& geometry = {});

// Tree A (crank), P (slider), U (rod on slider, universal); closure S spherical, crank first.
Linkage spatial_slider_crank();

// Tree A, S (rod on crank, spherical zyx), P; closure U universal, slider first (x along the
// ground's x), rod second (y perpendicular to the rod and x).
Linkage spatial_slider_crank_cut_at_universal();

inline constexpr double kSpatialSliderCrankEnergy = 0.76643568;  // J, potential zero at z = 0

}  // namespace linkstudy::testing
