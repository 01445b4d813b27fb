// The measured data that a study names, read from their files or from what results keep of them.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

// All that is compared with files, in the order that digests and results take: the common
// reference, then the load cases or experiments.
std::vector<MeasuredInput*> measured_inputs(StudyInput& input);
std::vector<const MeasuredInput*> measured_inputs(const StudyInput& input);

// Texts of the data, each file once.
std::vector<DataText> data_texts(const StudyInput& input);

// Columns that lack the time, or anything beside it; `owner` ("experiment 'on'") is named at `at`.
void check_columns(const MeasuredInput& measured, const std::string& owner, const Location& at,
                   Diagnostics& diagnostics);

// Fills the data. `kept`: what results hold of the files, which are not read then; or null.
void read_measured(StudyInput& input, const std::vector<DataText>* kept, Diagnostics& diagnostics);

}  // namespace linkstudy
