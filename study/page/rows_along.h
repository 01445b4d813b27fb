// Evaluations along some parameters, all others at their usual values: curves and maps of errors.
#pragma once

#include <optional>
#include <vector>

#include "study/record/evaluation.h"

namespace linkstudy {

// The number of a parameter in every evaluation; nothing where one has a word.
std::optional<std::vector<double>> parameter_numbers(const std::vector<Evaluation>& rows,
                                                     std::size_t parameter);

// Rows where every parameter but those left free has its most frequent value (of equals the first),
// words too, one parameter after the other; ascending.
std::vector<std::size_t> usual_rows(const std::vector<Evaluation>& rows,
                                    const std::vector<std::size_t>& free);

// Those where this one and parameters of words are free, ascending in this one; none where it has
// words.
std::vector<std::size_t> rows_along(const std::vector<Evaluation>& rows, std::size_t parameter);

}  // namespace linkstudy
