// The cases of a design by the positions of their values, and a bounded selection of them to try
// before anything runs. Only cases that occur: a list pairs its values.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

// One position for each axis.
using CasePositions = std::vector<std::size_t>;

// Number of cases; nothing when there are more than a study may have. `sizes` are the numbers of
// values; those of a list are equal.
std::optional<std::uint64_t> count_cases(Design design, const std::vector<std::size_t>& sizes);

// All cases where there are at most `most`. Of a longer list, `most` of them evenly, both ends
// included. Of a larger grid, for every axis up to `most` of its values, beside the first and
// beside the last values of all others.
std::vector<CasePositions> choose_cases(Design design, const std::vector<std::size_t>& sizes,
                                        std::size_t most);

}  // namespace linkstudy
