// The same measurement in several processes at once, as ranks of one machine run.
#pragma once

#include <functional>
#include <vector>

namespace linkstudy::plan {

// What each process has measured; fewer where one failed. They are copies of this one, made while
// it has no other threads.
std::vector<double> measure_at_once(int processes, const std::function<double()>& measure);

}  // namespace linkstudy::plan
