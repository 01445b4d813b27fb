// Planar crank-rocker in the x-y plane, joints about z, links along their local x, gravity -y:
// ground pivots A (origin) and D (g, 0), crank a = AB, coupler b = BC, rocker c = DC.
// Closed form: C is the intersection of circles b about B and c about D, on the left of B -> D;
//   coupler rate = -a w sin(rocker - crank) / (b sin(rocker - coupler)),
//   rocker rate  =  a w sin(coupler - crank) / (c sin(coupler - rocker)).
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct FourBarGeometry {
  double crank = 0.10, coupler = 0.35, rocker = 0.30, ground = 0.40;  // m
};

// Angles against x and their rates, rad and rad/s.
struct FourBarPose {
  double crank, coupler, rocker;
  double crank_rate, coupler_rate, rocker_rate;
};
FourBarPose four_bar_pose(double crank, double crank_rate, const FourBarGeometry& geometry = {});

// Tree A (crank), B (coupler on crank), D (rocker); closure C revolute, coupler first. Starts
// closed at crank = 1 rad, 5 rad/s.
Linkage four_bar(const FourBarGeometry& geometry = {});

}  // namespace linkstudy::testing
