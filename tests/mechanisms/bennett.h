// Bennett linkage: four revolute joints whose axes neither meet nor run parallel, and yet one
// degree of freedom: opposite links are equal, lengths a, b and twists alpha, beta with
// a sin(beta) = b sin(alpha). Of the five equations of a cut revolute joint three are redundant.
// Joint angles in the convention of Denavit and Hartenberg (link = Tx(length) Rx(twist)):
//   theta3 = -theta1, theta4 = -theta2,
//   tan(theta1/2) tan(theta2/2) = sin((beta + alpha)/2) / sin((beta - alpha)/2)
// (tests/laws holds that the loop closes and stays closed).
#pragma once

#include <cmath>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct BennettGeometry {
  double a = 0.25;                 // m, crank and follower
  double alpha = 40 * M_PI / 180;  // rad, twist of the links of length a
  double beta = 75 * M_PI / 180;   // rad, of coupler and ground
  double crank = 1.0, rate = 3.0;  // theta1 at the start, rad and rad/s
  double b() const;                // length of coupler and ground, m
};

// Tree: crank (joint A on ground), coupler (joint B on crank), follower (joint D on ground);
// closure C revolute, coupler first. Starts closed, moving.
Linkage bennett(const BennettGeometry& geometry = {});

}  // namespace linkstudy::testing
