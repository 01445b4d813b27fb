// Linkages drawn from a seed, the same on every machine: branching trees of all joint types with
// offset frames on both sides, full inertia tensors (of point-mass clouds, so they are physical),
// offset centres of mass, all kinds of load; and the same with one closed loop.
#pragma once

#include <cstdint>
#include <vector>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct RandomTree {
  int links = 7;
  std::vector<JointType> types = {};  // drawn from; empty: all nine
  bool shuffled = true;               // joints and links listed in any order
  bool loads = true;
};

// Angles within 0.6 rad (far from the singular orientation of zyx), velocities within 1.
Linkage random_tree(std::uint64_t seed, const RandomTree& options = {});

// A random tree closed by one closure of the given type between two of its links. The start closes
// the loop in position and velocity, free directions of the closure are displaced and the rows are
// independent with at least two freedoms left.
Linkage random_closed_linkage(std::uint64_t seed, JointType closure, ClosureModel model);

// Two free bodies near each other, joined by one sde of the given closure type, no gravity, moving.
// `spread` scales how far the frames stand apart, m and rad.
Linkage sde_pair(std::uint64_t seed, JointType closure, const Sde& sde, double spread = 0.1);

}  // namespace linkstudy::testing
