// The four topologies of [AugUrb18] fig. 1 with real joints and links; all numbers are ours.
// Flexible links come expanded.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

// (a) Open, serial: a column that is driven about the vertical (A, friction), a flexible boom on it
// (B, friction), a carriage that slides along its last element (C, friction, held by a spring).
Linkage jib();

// (c) Open, tree: a body that floats freely (F), a flexible boom turning on it (B, friction, pulled
// by a spring) and a wheel that spins (W, friction). No gravity.
Linkage satellite();

// (d) Closed, tree: the crank of the RSUP linkage balanced, and its loop twice: the second is the
// first turned by half a turn about the crank's axis. Clearance and friction in R and R2, couplers
// of two rigid finite elements. No gravity: both halves move alike.
Linkage twin_rsup();

}  // namespace linkstudy::testing
