// Which entries of the constant frames, vectors and inertias of a model are trivial: what the step
// loop may skip (core/model/mechanism.h).
#pragma once

#include <Eigen/Core>

#include "core/model/mechanism.h"

namespace linkstudy {

// Entries must be zero exactly.
VectorShape shape_of(const Eigen::Vector3d& a);

// Up to the rounding that a few quarter turns leave; `quarter` is written unless general.
RotationShape shape_of(const Eigen::Matrix3d& r, QuarterTurn& quarter);

// Differences below rounding of the sum count as equal.
InertiaShape shape_of_inertia(const Eigen::Matrix3d& i);

}  // namespace linkstudy
