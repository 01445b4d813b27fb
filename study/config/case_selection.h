// A bounded selection of the cases of a design, to try before anything runs, by the positions of
// their values or by their numbers. Only cases that occur: a list pairs its values.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

std::vector<Axis> axes_of(const StudyInput& input);

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

// Numbers of points to try of a design whose points are not put together from values, both ends
// included.
std::vector<std::uint64_t> choose_ids(const DesignOptions& design, const std::vector<Axis>& axes,
                                      std::size_t most);

// Whether points are combinations of values, one of each axis: choose_cases speaks of them.
constexpr bool combines_values(Design design) {
  return design == Design::grid || design == Design::list || design == Design::vector;
}

}  // namespace linkstudy
