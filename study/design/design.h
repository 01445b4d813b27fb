// A design says which points of the parameter space are evaluated: a pure function of the axes.
// A point's id is its position; a design without axes is the base model alone, one point.
// Bad axes or too many points raise std::invalid_argument with the remedy.
#pragma once

#include <cstdint>
#include <vector>

#include "study/design/axis.h"
#include "study/record/design_kind.h"

namespace linkstudy {

std::uint64_t count_points(Design design, const std::vector<Axis>& axes);

// One point without the others, for id < count_points.
Point make_point(Design design, const std::vector<Axis>& axes, std::uint64_t id);

std::vector<Point> make_points(Design design, const std::vector<Axis>& axes);

}  // namespace linkstudy
