// What a tuner judges of an evaluation, in every load case: the errors of each [[match]], and what
// [[limit]] bounds as errors of tolerance 1,
//   at most B:  1 + (v - B) / |B|,     at least B:  1 + (B - v) / |B|,
// not below 0, so that 1 is the bound and 1.1 misses it by a tenth of it (B = 0: by 0.1 in the unit
// of v). And the numbers that an objective is made of.
#pragma once

#include "study/metrics/response_list.h"

namespace linkstudy {

struct Bound {
  double value = 0.0;  // in `unit`
  bool is_upper = true;
  std::string unit;
};

struct JudgedError {
  std::string name;               // "closure.S.force.x", the load case in front where there are any
  std::size_t response = 0;       // in list_responses
  std::vector<double> tolerance;  // one, or one for each answer that is wanted
  std::optional<Bound> bound;     // of a limit
};

double error_of(const JudgedError& judged, double value);

// Limits on what no evaluation answers, and bounds in wrong units, are reported at their places.
std::vector<JudgedError> list_judged_errors(const StudyInput& input, const StudySignals& signals,
                                            Diagnostics& diagnostics);

// The responses, of all load cases, that the objective of a tune names; none where it names a tuned
// value or there is none. What it names in vain is reported.
std::vector<std::size_t> list_objective_responses(const StudyInput& input,
                                                  const StudySignals& signals,
                                                  Diagnostics& diagnostics);

}  // namespace linkstudy
