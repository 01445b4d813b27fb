// A forecast as text for people and as the object of --json; the evaluations as a table.
#pragma once

#include "study/plan/forecast.h"
#include "study/record/table.h"

namespace linkstudy::plan {

std::string write_text(const StudyInput& input, const Forecast& forecast);
std::string write_json(const StudyInput& input, const Forecast& forecast);
// `evaluation`, then the parameters by their names in results.
Table evaluations_table(const Evaluator& study, const PlannedWork& work);

}  // namespace linkstudy::plan
