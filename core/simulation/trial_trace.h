// A trial of an adaptive step, and an instant inside one, as expression graphs over the slots of
// core/simulation/trial_slots.h, made by a run of them on tracing scalars (core/codegen/traced.h).
#pragma once

#include "core/simulation/step_trace.h"

namespace linkstudy {

// Arguments as of trace_step. Throw Untraceable.
StepTrace trace_trial(const Mechanism& m, const Parameters<double>& sizes,
                      const std::vector<Known>& known, const std::vector<Channel>& observed,
                      bool rows_may_depend);
StepTrace trace_inside(const Mechanism& m, const Parameters<double>& sizes,
                       const std::vector<Known>& known, const std::vector<Channel>& observed,
                       bool rows_may_depend);

}  // namespace linkstudy
