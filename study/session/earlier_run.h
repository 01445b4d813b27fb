// Runs of earlier results that stand for measurements.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

// Takes the histories of the evaluation, in the load case, that an input names. It must have ended
// ok; without a name it must be the only one. Results are read once by each reader.
ReadEarlierRun earlier_run_reader();

// Results cannot be made of themselves: an InputError where `output` is the source of data.
void refuse_own_results(const StudyInput& input, const std::string& output);

}  // namespace linkstudy
