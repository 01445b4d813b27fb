// Von Mises truss in the x-y plane: two elastic bars from the ground at (-a, 0) and (a, 0) to an
// apex, stress-free with the apex at (0, h), pressed down there by F. Bar of length L at the height
// y of the apex: L = sqrt(a^2 + y^2), axial force k (L0 - L), L0 = sqrt(a^2 + h^2), and
//   F(y) = 2 k (L0 - L) y / L,
// greatest at L^3 = L0 a^2: the limit load, past which the apex snaps through to below. Stiffness
// against y: -dF/dy.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct TrussData {
  double half_span = 1.0;    // a, m
  double rise = 0.3;         // h, m
  double stiffness = 1.0e4;  // k, N/m
};

double truss_load(const TrussData& data, double y);  // F(y), N
double truss_limit_height(const TrussData& data);    // y of the limit load, m
double truss_limit_load(const TrussData& data);      // N
// The height of the apex under F by bisection: above the limit height, or below the ground.
double truss_height(const TrussData& data, double force, bool snapped);

// Joints A1, P1, A2, P2 (revolute and prismatic, each bar), closure C at the apex, load F.
Linkage von_mises_truss(double force, const TrussData& data = {});

}  // namespace linkstudy::testing
