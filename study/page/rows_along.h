// Evaluations along one parameter, all others at their usual values: the curves of errors.
#pragma once

#include <optional>
#include <vector>

#include "study/record/evaluation.h"

namespace linkstudy {

// The number of a parameter in every evaluation; nothing where one has a word.
std::optional<std::vector<double>> parameter_numbers(const std::vector<Evaluation>& rows,
                                                     std::size_t parameter);

// Rows that have the most frequent value of every other parameter of numbers, ascending in this
// one; none where it has words.
std::vector<std::size_t> rows_along(const std::vector<Evaluation>& rows, std::size_t parameter);

}  // namespace linkstudy
