// Every combination of the axes' values. Row-major: the last axis runs fastest, so that with sizes
// n_0 .. n_k point id = (..(i_0 n_1 + i_1) n_2 + ..) n_k + i_k.
#pragma once

#include <cstdint>
#include <vector>

#include "study/design/axis.h"

namespace linkstudy {

// Product of the axes' sizes (1 without axes); over kMaxPoints it is a std::invalid_argument.
std::uint64_t count_grid(const std::vector<Axis>& axes);

Point make_grid_point(const std::vector<Axis>& axes, std::uint64_t id);

}  // namespace linkstudy
