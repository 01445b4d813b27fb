// Mobility of a linkage at a closed pose: what its joints should leave free by counting, what they
// leave free to first order, what really moves, and which joints hold the same motion twice.
//
//   Kutzbach number          nv - nc = 6 (links - 1) - sum over joints (6 - f)
//   instantaneous mobility   nv - rank J, the null space of the closure Jacobian J (nc, nv)
//   mobility                 dimension of the closed poses around this one
// The last is measured: steps along the null space are brought back to closed poses, and the
// displacements that remain span the motions that exist. A singular state ([Palcak] (4.110)) is
// permanent where rank J < nc at the neighbours as well, instantaneous where J loses rank here
// only.
//
// Every closure counts as the exact joint of its type. Ranks are those of the scaled Jacobian
// (scaled_closures.h) with a relative tolerance above the error of assembly.
#pragma once

#include <vector>

#include "core/kinematics/idle_freedoms.h"
#include "core/kinematics/redundant_joints.h"
#include "core/kinematics/scaled_closures.h"
#include "core/numerics/rank.h"

namespace linkstudy {

// Of ranks at neighbours, in place of kMobilityTolerance: within the error of assembly a shaky
// linkage is closed a little off its pose, too.
inline constexpr double kNeighbourTolerance = 1e-5;

enum class SingularState { none, instantaneous, permanent };

struct MobilityReport {
  int links = 0;        // ground included
  int joints = 0;       // closures included
  int loops = 0;        // independent ones: joints - links + 1
  int coordinates = 0;  // freedoms of all joints, closures included
  int velocities = 0;   // of the tree joints, nv
  int rows = 0;         // closure equations, nc
  int kutzbach = 0;
  NumericalRank rank;              // at the pose
  int regular_rank = 0;            // at the neighbours
  int instantaneous_mobility = 0;  // nv - rank
  int mobility = 0;
  int redundant = 0;  // rows - regular_rank
  SingularState state = SingularState::none;
  std::vector<CarriedRedundancy> redundant_joints;  // those with a count above zero
  std::vector<IdleFreedom> idle;
  std::vector<State<double>> neighbours;  // closed poses near the given one
};

// At a closed pose; where it is open by some residual it is judged by the rank only: `neighbours`
// is empty and the mobility that of first order.
MobilityReport analyse_mobility(const Model& closed, const State<double>& pose);

}  // namespace linkstudy
