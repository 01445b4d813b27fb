// How long tasks take that are pulled: whoever is idle gets the next one.
#pragma once

#include <span>

namespace linkstudy::plan {

struct PullEnd {
  double wall_s = 0.0;  // until the last has ended
  double busy = 1.0;    // part of the ranks' time that is work
};

// Tasks in the order they are handed out, s.
PullEnd pull(std::span<const double> tasks, int ranks);

}  // namespace linkstudy::plan
