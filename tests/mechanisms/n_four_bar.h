// Benchmark A02 of the IFToMM library: N square four-bars in a row, N + 1 vertical rods on the
// ground and N horizontal ones, each 1 m and 1 kg (slender), gravity 9.81 in -y, the top left
// corner at 1 m/s to the right. When the rods lie flat the mobility jumps from 1 to N + 1. On the
// branch of parallel rods with angle theta from the vertical, per unit mass and length:
//   theta_dot^2 ((N + 1)/3 + N) = 2 E,  E + g (cos theta - 1) ((N + 1)/2 + N) = const
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

// Tree: A0..AN (rods on the ground), B1..BN (bar k on rod k - 1); closures C1..CN revolute, bar k
// first, rod k second. Rods and bars lie along their local x.
Linkage n_four_bar(int loops = 2);

// Time of a full turn of the parallel rods, by quadrature of the closed form, s.
double n_four_bar_period(int loops);

inline constexpr double kTwoFourBarPeriod = 1.942514923;  // s, published for N = 2

}  // namespace linkstudy::testing
