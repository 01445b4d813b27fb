// A trial of an adaptive step as an expression graph over the slots of
// core/simulation/trial_slots.h, made by a run of it on tracing scalars (core/codegen/traced.h).
#pragma once

#include "core/simulation/step_trace.h"

namespace linkstudy {

// Arguments as of trace_step. Throws Untraceable.
StepTrace trace_trial(const Mechanism& m, const Parameters<double>& sizes,
                      const std::vector<Known>& known);

}  // namespace linkstudy
