// A tune file as the problem and the options of the tuner.
#pragma once

#include "study/evaluate/evaluator.h"
#include "study/tune/tuning_problem.h"

namespace linkstudy {

// The step of the model as base.set leaves it, with tuned values at their low ends. Throws
// InputError.
double base_step_of(const StudyInput& input);

// An answer for every step and, at each, for every tolerance.
std::vector<tuning::TuningTarget> make_tuning_targets(const Evaluator& evaluator);
tuning::TuningOptions make_tuning_options(const StudyInput& input);

// The budget of all answers.
std::uint64_t most_tuning_evaluations(const StudyInput& input);

// What this version does not tune, at its places.
void check_tune(const StudyInput& input, Diagnostics& diagnostics);

// What the tuner itself finds wrong, at the places of the file.
void check_tuning(const Evaluator& evaluator, Diagnostics& diagnostics);

}  // namespace linkstudy
