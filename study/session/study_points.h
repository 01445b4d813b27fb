// The points of a study in the order of their ids, and what runs one of them. A tune has one
// parameter more, simulation.step, because its certificate halves it.
#pragma once

#include <memory>
#include <vector>

#include "study/config/study_input.h"
#include "study/evaluate/evaluator.h"

namespace linkstudy {

std::vector<Parameter> parameters_of(const StudyInput& input);
std::vector<Point> points_of(const StudyInput& input);
// Their number, without them.
std::uint64_t count_of(const StudyInput& input);
std::unique_ptr<Evaluator> make_evaluator(const StudyInput& input, Diagnostics& diagnostics);

}  // namespace linkstudy
