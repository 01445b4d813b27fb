// Runs by an adaptive integrator side by side: every lane of a pack is a run of its own
// (core/simulation/located_run.h) with a time and a step of its own, and takes the next case when
// one has ended. A pass of the kernel makes one trial in each lane, or evaluates an instant of
// each. Implicit runs go one at a time.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/base/isa.h"
#include "core/simulation/located_run.h"

namespace linkstudy {

// start(i): the setting of case i, asked for when it begins. Reports by case.
std::vector<LocatedReport> run_located(const Mechanism& m, const SimulationOptions& options,
                                       std::span<const LaneCase> cases, const SimdLevel& level,
                                       const std::function<KernelRun(std::size_t)>& start);

}  // namespace linkstudy
