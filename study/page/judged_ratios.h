// How well evaluations keep what their study asks for: which points of a map are feasible.
#pragma once

#include <vector>

#include "study/store/results.h"

namespace linkstudy {

// By row the largest error over its tolerance, of every [[match]] and [[limit]] in every load case
// (judged_errors.h): at most 1 is feasible. Of several tolerances the tightest. NaN where the
// evaluation failed or lacks a number that is judged. Empty where nothing is judged, and of
// results that this program cannot run again.
std::vector<double> judged_ratios(const StudyResults& results, const std::vector<Evaluation>& rows);

}  // namespace linkstudy
