// A tune file as the problem and the options of the tuner.
#pragma once

#include "study/evaluate/evaluator.h"
#include "study/tune/tuning_problem.h"

namespace linkstudy {

tuning::TuningProblem make_tuning_problem(const Evaluator& evaluator);
tuning::TuningOptions make_tuning_options(const StudyInput& input);

// What this version does not tune, at its places.
void check_tune(const StudyInput& input, Diagnostics& diagnostics);

// What the tuner itself finds wrong, at the places of the file.
void check_tuning(const Evaluator& evaluator, Diagnostics& diagnostics);

}  // namespace linkstudy
