// A design says which points of the parameter space are evaluated: a pure function of its options
// and the axes. A point's id is its position; a design without axes is the base model alone, one
// point. More samples, blocks or trajectories keep the points there were (of a Latin hypercube:
// twice as many do).
// Bad axes or too many points raise std::invalid_argument with the remedy.
#pragma once

#include <cstdint>
#include <vector>

#include "study/design/axis.h"
#include "study/design/design_options.h"

namespace linkstudy {

std::uint64_t count_points(const DesignOptions& design, const std::vector<Axis>& axes);

// One point without the others, for id < count_points.
Point make_point(const DesignOptions& design, const std::vector<Axis>& axes, std::uint64_t id);

// The same point of a sampled design in the unit cube, before the distributions.
std::vector<double> make_unit_point(const DesignOptions& design, std::size_t parameters,
                                    std::uint64_t id);

std::vector<Point> make_points(const DesignOptions& design, const std::vector<Axis>& axes);

}  // namespace linkstudy
