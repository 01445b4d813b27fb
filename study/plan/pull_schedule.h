// How long tasks take that are pulled: whoever is idle gets the next one.
#pragma once

#include <span>

namespace linkstudy::plan {

struct PullEnd {
  double wall_s = 0.0;  // until the last has ended
  double busy = 1.0;    // part of the ranks' time that is work
};

// Tasks in the order they are handed out, s. `service_s`: what the rank that hands them out takes
// for each, one after the other (measured by tests/bench/dispatch.cpp).
PullEnd pull(std::span<const double> tasks, int ranks, double service_s = 0.0);

}  // namespace linkstudy::plan
