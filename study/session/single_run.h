// One run of a prepared model, watched.
#pragma once

#include <optional>
#include <string>

#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "study/config/model_reader.h"
#include "study/schedule/progress.h"

namespace linkstudy {

// Time, then all channels or those of `signals` ("closure.S.force,energy") in the order asked for,
// at the output interval. Throws UsageError with what --signals gets wrong.
Series choose_series(const ModelInput& input, const std::optional<std::string>& signals);

// `timeout_s` 0: none.
SimulationOutcome run_watched(const Preparation& preparation, const SimulationOptions& options,
                              Observers& observers, double timeout_s, ProgressMode progress);

}  // namespace linkstudy
