// The coarsest time grid that two runs with constant steps share, so that their histories are
// compared at equal instants and nothing is interpolated:
//   h / h_ref = p / q with coprime p, q   =>   every q-th step of the one meets every p-th of the
//   other.
// Units: s.
#pragma once

#include <optional>

#include "core/simulation/observers.h"
#include "core/simulation/simulate.h"
#include "study/config/study_input.h"

namespace linkstudy {

// Steps of both runs between instants of the common grid.
struct CommonGrid {
  long stride = 1;            // q
  long reference_stride = 1;  // p
};

// p and q beyond this leave too few instants to compare at.
inline constexpr long kLargestRatio = 1000;

// Nothing when the ratio of the steps is no fraction of integers up to kLargestRatio, to 1e-9.
std::optional<CommonGrid> find_common_grid(double step, double reference_step);

// The steps (multiples of `stride`) in a window, both ends included. Without a window: the whole
// run except its start, where an unloaded spring never matches.
Sampling sample_window(const StepGrid& grid, long stride, const std::optional<TimeWindow>& window);

// What the window has before and after its samples.
WindowEnds find_window_ends(const StepGrid& grid, const Sampling& sampling,
                            const std::optional<TimeWindow>& window);

}  // namespace linkstudy
