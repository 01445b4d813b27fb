// Which runs can go side by side in the lanes of one step loop: one structure, one step grid and
// start time, one integrator with its tolerances and limits, observers of one form.
#pragma once

#include "core/model/compile.h"
#include "core/simulation/observers.h"
#include "core/simulation/options.h"

namespace linkstudy {

struct StepRun {
  const Model& model;
  const SimulationOptions& options;
  const Observers& observers;
};

bool can_share_steps(const StepRun& a, const StepRun& b);

// Positions of runs, each beside the first it can share with; in the order given.
template <class Runs, class CanShare>
std::vector<std::vector<std::size_t>> group_alike(const Runs& runs, const CanShare& can_share) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto found = std::ranges::find_if(
        groups, [&](const auto& group) { return can_share(*runs[group.front()], *runs[i]); });
    if (found == groups.end()) {
      groups.push_back({i});
    } else {
      found->push_back(i);
    }
  }
  return groups;
}

}  // namespace linkstudy
