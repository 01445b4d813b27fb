#include "study/plan/pull_schedule.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <vector>

namespace linkstudy::plan {

PullEnd pull(std::span<const double> tasks, int ranks, double service_s) {
  std::priority_queue<double, std::vector<double>, std::greater<>> idle_at;
  for (int i = 0; i < ranks; ++i) idle_at.push(0.0);
  PullEnd end;
  double work = 0.0;
  double served_until = 0.0;
  for (const double task : tasks) {
    served_until = std::max(idle_at.top(), served_until) + service_s;
    const double done = served_until + task;
    idle_at.pop();
    idle_at.push(done);
    end.wall_s = std::max(end.wall_s, done);
    work += task;
  }
  if (end.wall_s > 0.0) end.busy = work / (end.wall_s * static_cast<double>(ranks));
  return end;
}

}  // namespace linkstudy::plan
