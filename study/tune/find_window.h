// The two ends of the feasible window of one variable, from a log that knows a feasible value.
#pragma once

#include <optional>

#include "study/tune/evaluation_log.h"
#include "study/tune/tuning_result.h"

namespace linkstudy::tuning {

// Lowest value known to be accepted at both steps.
std::optional<double> find_lowest_accepted(const EvaluationLog& log);
// Lowest value feasible at the base step and not yet rejected at half of it.
std::optional<double> find_lowest_candidate(const EvaluationLog& log);

// Closes on the boundary below a candidate, then tries half the step there. If that fails, climbs
// through the window until both steps match and closes on that boundary. Returns the lowest
// accepted value, or the candidate closed on when none was accepted.
double descend(EvaluationLog& log, double candidate);

// Closes on the upper end of the window that starts at `low`, to the resolution too. Failing values
// that have a matching one within the neighbourhood above them are taken for noise and do not end
// the window.
Window find_window(EvaluationLog& log, double low);

}  // namespace linkstudy::tuning
