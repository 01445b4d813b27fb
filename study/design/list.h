// The axes side by side: point i takes value i of every axis, so all axes are equally long.
#pragma once

#include <cstdint>
#include <vector>

#include "study/design/axis.h"

namespace linkstudy {

// The common length (1 without axes); unequal axes are a std::invalid_argument that names two.
std::uint64_t count_list(const std::vector<Axis>& axes);

Point make_list_point(const std::vector<Axis>& axes, std::uint64_t id);

}  // namespace linkstudy
