// Tuning results as tables, for the results file and for `export`.
#pragma once

#include <vector>

#include "study/record/table.h"
#include "study/tune/tuning_result.h"

namespace linkstudy::tuning {

// "result" (one row: the answer, its damping in SI units, window, margin, verdict), "components" at
// the answer, "scan" (every value tried at the base step), "certificate" (one row a claim, ids
// separated by blanks), "evaluations" (every one, in the order asked), "staircase" (minimal points
// of several variables, by their objective).
std::vector<Table> make_tables(const TuningResult& result);
// Of several targets: the same tables, one under the other, with tolerance and step in front.
std::vector<Table> make_tables(const std::vector<TuningResult>& results);

}  // namespace linkstudy::tuning
