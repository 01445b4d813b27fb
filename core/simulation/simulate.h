// Runs from a prepared start: constant steps of the classical Runge-Kutta method, or adaptive ones
// with contacts located (core/simulation/located_run.h); observers on the grid of steps, and a
// typed cause at the end. A run that fails numerically is a result.
//
// A run of constant steps that went past the stability limit along it
// (core/simulation/step_limit.h) is right only if it balances: one whose energy leaves a gap
// (energy_balances), or whose bristles leave their law (core/simulation/step_watch.h), has failed
// (step_too_coarse).
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "core/base/isa.h"
#include "core/model/parameters.h"
#include "core/model/state.h"
#include "core/simulation/cause.h"
#include "core/simulation/observers.h"
#include "core/simulation/options.h"
#include "core/simulation/step_limit.h"

namespace linkstudy {

// Packs of cases with constant steps that may run at once: two where a written step has registers
// for both and is short enough (core/simulation/written_steps.h).
int packs_beside(const SimdLevel& level);

// Equal steps that fill the run: count = ceil(end_time / step), h = end_time / count.
struct StepGrid {
  long count;
  double h;
};
StepGrid make_step_grid(const SimulationOptions& options);

// The instants of a grid that are an output interval apart, in whole steps.
Sampling sample_output(const StepGrid& grid, double output_interval);

struct RunLimits {
  double timeout_s = 0.0;                        // wall time of the run, 0: none
  const std::atomic<bool>* cancelled = nullptr;  // checked now and then
  std::atomic<double>* reached = nullptr;        // s, model time, stored now and then
};

struct SimulationOutcome {
  Cause cause = Cause::ok;
  std::string message;
  std::string warning;               // of a run that is ok, or empty
  double end_time = 0.0;             // reached, s
  long steps = 0;                    // accepted
  long rejected = 0;                 // tried again with a shorter step; adaptive, stiff
  long evaluations = 0;              // of the equations of motion
  double drift_max = 0.0;            // largest cut-joint residual, norm over all rows (m, 1)
  double energy_residual_max = 0.0;  // J, at the output instants
  double energy_scale = 0.0;         // J, largest kinetic energy or work seen there
  bool redundant = false;            // cut rows were dependent at some instant
  int least_rank = -1;               // independent cut rows over the steps; -1: no step
  int greatest_rank = -1;  // more than the least: a singular pose was passed, or steps are coarse
  long contacts = 0;       // of journals with bearings and at end stops, begun
  long least_contact_steps = 0;  // steps in the shortest contact that has ended; 0: none
  StepLimit step_limit;          // worst along the run; adaptive, stiff: as known before
  State<double> final_state;
};

// The energy ledger is closed but for 1 % of the energies in it, as far as it was looked at.
bool energy_balances(const SimulationOutcome& outcome);

// One run on one lane of the instruction set in use. known: the limit at its start.
SimulationOutcome simulate(const Mechanism& mechanism, const Parameters<double>& parameters,
                           const State<double>& start, const SimulationOptions& options,
                           Observers& observers, const RunLimits& limits = {},
                           const StepLimit& known = {});

struct BatchCase {
  const Parameters<double>* parameters = nullptr;
  const State<double>* start = nullptr;  // t the same in all cases
  Observers* observers = nullptr;        // of the same form in all cases
  SimulationOutcome outcome;             // written
  StepLimit known{};                     // before the run: of its start
  bool known_along = false;              // of a whole run like this one, too
};

// Runs of one structure and one step grid, several at a time in the lanes of a pack, in the order
// given. The outcome of a case, to the last bit, is that of `simulate`. A time limit is one for
// each pack. Adaptive runs have a time and steps of their own in every lane, which takes the next
// case when one has ended, so that any number of cases keeps all lanes at work; their time limit
// counts from there. Stiff ones go one at a time.
void simulate_batch(const Mechanism& mechanism, const SimulationOptions& options,
                    std::vector<BatchCase>& cases, const RunLimits& limits = {});

// The same by step loops of choice, for comparisons of them.
void simulate_batch(const Mechanism& mechanism, const SimulationOptions& options,
                    std::vector<BatchCase>& cases, const RunLimits& limits, const SimdLevel& level);

}  // namespace linkstudy
