// One run on one lane by an adaptive integrator, with the begin and the end of every contact
// located. Observers see the instants of the step grid, t0 + k h, by the dense output of the
// integrator and an evaluation of the equations of motion there; only those that some observer or
// the energy ledger asks for.
//
// Between two events each contact keeps to its phase: one that is open has no force even where
// rounding puts it inside, one that touches has the approach speed of its beginning, raised where
// it is driven faster later if ApproachSpeed::greatest is asked for. At an event the integrator
// starts anew: in contact with the first step that the last contact began with, out of contact with
// the steps from before it. Bristles that start afresh are set to zero when their contact ends.
//
// More than kMostContacts contacts begun within one output interval end the run (contact_budget):
// bounces whose times have a limit would otherwise never reach it.
#pragma once

#include "core/simulation/kernel.h"
#include "core/simulation/options.h"

namespace linkstudy {

inline constexpr long kMostContacts = 20'000;

struct LocatedReport {
  double end_time = 0.0;  // reached, s
  long steps = 0;         // accepted
  long rejected = 0;
  long evaluations = 0;  // of the equations of motion, those for observers included
  long looks = 0;        // at positions and rates only, for contacts and drift
};

// Fills c.end (its `steps`: instants of the grid reached), c.final_y and the observers.
LocatedReport run_located(const Mechanism& m, const SimulationOptions& options,
                          const KernelRun& setting, const LaneCase& c);

}  // namespace linkstudy
