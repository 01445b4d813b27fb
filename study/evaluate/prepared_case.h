// Points in a load case, ready to run, and runs of those that can share step loops: one
// structure, one step grid, observers of one form. How cases are put together changes no bit.
#pragma once

#include <memory>
#include <vector>

#include "core/simulation/prepare.h"
#include "study/evaluate/reference_run.h"
#include "study/metrics/run_metrics.h"

namespace linkstudy {

struct PreparedCase {
  std::size_t load_case;
  std::size_t point;  // position among the points evaluated together
  SimulationOptions options;
  Preparation preparation;
  RunMetrics metrics;
  SimulationOutcome outcome;  // written by run_cases
  KnownLimit limit{};         // of the step, before the run
};

// In the order given, each beside the first it can share a step loop with.
using CaseGroup = std::vector<PreparedCase*>;
std::vector<CaseGroup> group_cases(const std::vector<std::unique_ptr<PreparedCase>>& cases);

// A time limit is one for as many cases as run side by side.
void run_cases(const CaseGroup& group, const RunLimits& limits);

}  // namespace linkstudy
