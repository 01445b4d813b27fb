// One parameter at a time around a centre: point 0 is the centre of all, then follow, axis by axis,
// the other values of the axis in their order, with all other parameters at their centres.
#pragma once

#include <cstdint>
#include <vector>

#include "study/design/axis.h"

namespace linkstudy {

// Over kMaxPoints it is a std::invalid_argument.
std::uint64_t count_centered(const std::vector<Axis>& axes);

Point make_centered_point(const std::vector<Axis>& axes, std::uint64_t id);

}  // namespace linkstudy
