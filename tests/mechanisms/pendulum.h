// Benchmark A01 of the IFToMM library: a point mass on a massless rod, let go from horizontal.
// Closed form of the period from amplitude theta0: 4 sqrt(L/g) K(sin(theta0 / 2)).
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

// Joint A about z, gravity -y; the rod points along its local x, so q = 0 is horizontal.
Linkage pendulum(double mass = 1.0, double length = 1.0);

// Period of an oscillation that starts at rest `amplitude` away from hanging.
double pendulum_period(double length, double gravity, double amplitude);

inline constexpr double kPendulumPeriod = 2.367841948;  // s, published for m = 1 kg, L = 1 m

}  // namespace linkstudy::testing
