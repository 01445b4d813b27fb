// What runs the evaluations of results again, from what they hold of their input.
#pragma once

#include <memory>

#include "study/evaluate/evaluator.h"
#include "study/store/results.h"

namespace linkstudy {

// Refuses results whose columns are those of another program.
[[noreturn]] void throw_other_columns(const StudyResults& results);

// Throws StoreError (results too old, other columns than this program has) and InputError.
std::unique_ptr<Evaluator> make_stored_evaluator(const StudyResults& results);

}  // namespace linkstudy
