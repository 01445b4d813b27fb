// What a file will take before it runs: evaluations, CPU and wall time for numbers of ranks, memory
// and disk. Wall time is that of the references, side by side, and then of packs, the longest
// first, pulled by ranks (form_packs, pull_schedule.h). How ranks of one machine slow each other
// down is measured here, with as many at once as this machine runs of them; nodes are taken for its
// like.
#pragma once

#include "study/plan/costs.h"
#include "study/plan/sizes.h"

namespace linkstudy::plan {

struct Layout {
  int ranks = 1;
  std::size_t packs = 0;
  std::size_t widest = 0;  // evaluations side by side
  double cpu_s = 0.0;
  double wall_s = 0.0;
  double busy = 1.0;  // part of the ranks' time that is work, references aside
};

struct Forecast {
  PlannedWork work;
  std::size_t load_cases = 1;
  std::size_t references = 0;
  std::size_t invalid = 0;
  // Of the evaluations that are certain.
  double steps = 0.0;  // of constant steps
  long least_steps = 0;
  long most_steps = 0;
  bool has_adaptive = false;
  Measured measured;  // nothing where it was not asked for
  double references_s = 0.0;
  Layout asked;                 // of the evaluations that are certain
  Layout most;                  // of the budget, on as many ranks; of a design the same
  std::vector<Layout> layouts;  // of the budget
  int useful_ranks = 1;         // more do not shorten it
  int lanes = 1;
  Sizes sizes;
};

struct ForecastOptions {
  int ranks = 1;
  int lanes = 1;
  int processors = 1;    // of this machine
  double probe_s = 2.0;  // CPU time spent on measuring; 0: nothing is measured
};

Forecast make_forecast(Evaluator& study, const ForecastOptions& options);

}  // namespace linkstudy::plan
