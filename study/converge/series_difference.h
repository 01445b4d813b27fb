// A time history from level to level. Histories are compared at the instants that all levels keep,
// without interpolation, in the norms of match_error.h: the greatest magnitude, or the root mean
// square over time by the trapezoidal rule. The signed change of level k is
//   +- || x_k - x_(k-1) ||,  of the sign of the change before times that of the inner product of
//   both
// so that histories that swing about their limit oscillate and those that creep to it are monotone.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "study/config/study_input.h"
#include "study/converge/refinement.h"

namespace linkstudy::convergence {

// Of one channel; empty where the level failed.
struct History {
  std::span<const double> time;    // s, rising
  std::span<const double> values;  // as many
};

struct SeriesLadder {
  Ladder ladder;                  // values are norms of the histories
  std::vector<double> to_finest;  // || x_k - x_finest ||; NaN where the level failed
  std::size_t instants = 0;       // that all levels keep
};

// `h` coarse to fine, a history each. `reference`: what errors are taken against, where it keeps
// the instants of the levels. Nothing where all levels share fewer than two instants.
std::optional<SeriesLadder> make_series_ladder(const std::vector<double>& h,
                                               const std::vector<History>& histories,
                                               ErrorNorm norm,
                                               const std::optional<TimeWindow>& window,
                                               const std::optional<History>& reference = {});

// Instants within the window that all of them have, s; equal to 1e-9 of the largest.
std::vector<double> find_common_instants(const std::vector<std::span<const double>>& times,
                                         const std::optional<TimeWindow>& window);

}  // namespace linkstudy::convergence
