// From a checked description to the step loop's structure and numbers.
#pragma once

#include "core/model/mechanism.h"
#include "core/model/parameters.h"
#include "core/model/state.h"
#include "core/topology/linkage.h"

namespace linkstudy {

struct Model {
  Mechanism mechanism;
  Parameters<double> parameters;
  State<double> start;  // as given; not yet assembled
  // Velocities of joints with hold = true; joints of flexible links in compile_start only.
  std::vector<VelocityIndex> held;
};

// Of a linkage in which check() finds nothing. Bodies follow the order of Linkage::joints wherever
// that puts parents before children. Damping given as a ratio is zero until resolve_damping
// (dynamics). `idle`: for every closure the directions whose cut rows are left out
// (core/kinematics/idle_rows).
Model compile(const Linkage& linkage, const std::vector<unsigned>& idle = {});

// The same linkage with what must be closed when a run begins as cut rows: cut joints and
// clearances as compile has them, and of every closure of model sde its shut_directions.
Model compile_start(const Linkage& linkage, const std::vector<unsigned>& idle = {});

// Frame of a link in its body's internal frame: the inverse of the joint's child frame.
Frame link_in_body(const Joint& joint);

}  // namespace linkstudy
