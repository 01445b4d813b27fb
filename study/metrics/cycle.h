// The last full turns of a joint in a run: from the last instant t_b at which its angle was a
// number of whole turns away from where it ends,
//   |q(t_b) - q(t_e)| = 2 pi turns,
// to the end t_e of the run. Between two steps the angle is taken from the straight line, so that
// t_b is off by h^2 q'' / (8 q') at most.
#pragma once

#include <optional>
#include <string>

#include "core/simulation/observers.h"
#include "study/config/study_input.h"

namespace linkstudy {

// `angle`: one channel at every step from 0 on, `h` apart. Nothing where the joint does not turn so
// far. The place of the window is that of the cycle.
std::optional<TimeWindow> find_cycle(const CycleInput& cycle, const Series& angle, double h);

// Why there is none: how far the joint came.
std::string no_cycle_text(const CycleInput& cycle, const Series& angle);

}  // namespace linkstudy
