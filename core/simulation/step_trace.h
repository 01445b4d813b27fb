// The step loop's step, left as a graph by a run of it on tracing scalars (core/codegen/traced.h).
#pragma once

#include <vector>

#include "core/codegen/graph.h"
#include "core/model/mechanism.h"
#include "core/simulation/channels.h"
#include "core/simulation/step_slots.h"
#include "core/simulation/traced_parameters.h"

namespace linkstudy {

struct StepTrace {
  codegen::Graph graph;
  StepSlots slots;
};

// `known`: by number of for_parameter_numbers; `sizes`: parameters of any case. The graph writes
// the channels observed. Throws Untraceable.
// rows_may_depend: right for cut rows that depend on each other too, and longer by that.
StepTrace trace_step(const Mechanism& m, const Parameters<double>& sizes,
                     const std::vector<Known>& known, const std::vector<Channel>& observed,
                     bool rows_may_depend);

}  // namespace linkstudy
