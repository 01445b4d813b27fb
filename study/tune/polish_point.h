// Sections along the axes of a box from a point that matches, by the searches of one variable
// (axis_search.h, find_window.h).
#pragma once

#include "study/tune/tuning_result.h"

namespace linkstudy::tuning {

// Answers from a log that has the budget for them; throws std::logic_error where it has not.
EvaluateBatch ask_log(EvaluationLog& log);

// The point of smallest objective that matches at the base step and is not rejected at half of it;
// asks for half the step until it is accepted, or none is left.
std::optional<std::vector<double>> settle_lowest(EvaluationLog& log, std::size_t reserve);

// The least sum of log10: goes down along each axis until none gives more than the resolution.
std::vector<double> polish_point(EvaluationLog& log, std::vector<double> point,
                                 std::size_t reserve);

// Of an objective that leaves values free, or is a response: steps along the axes, of 0.1 decades
// at first and down to the resolution, to what is better, or as good and farther from its
// tolerances.
std::vector<double> polish_freely(EvaluationLog& log, std::vector<double> point,
                                  std::size_t reserve);

// The interval that matches along every axis, all side by side. It begins at the point where lower
// values are better.
std::vector<Window> find_windows(EvaluationLog& log, const std::vector<double>& point,
                                 std::size_t reserve);

}  // namespace linkstudy::tuning
