// The measured data that a study names, read from their files, from earlier results, or from what
// results keep of either.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

// All that is compared with data, in the order that digests and results take: the common
// reference, then the load cases or experiments.
std::vector<MeasuredInput*> measured_inputs(StudyInput& input);
std::vector<const MeasuredInput*> measured_inputs(const StudyInput& input);

// Texts of the data, each source once.
std::vector<DataText> data_texts(const StudyInput& input);

// The source of data in messages: a file, or an evaluation of results.
std::string source_name(const MeasuredInput& measured);

// Of a file, columns that lack the time or anything beside it; of results, columns that name a time
// of their own. `owner` ("experiment 'on'") is named at `at`.
void check_data(const MeasuredInput& measured, const std::string& owner, const Location& at,
                Diagnostics& diagnostics);

// Fills the data. `kept`: what results hold of them, whose sources are not read then; or null.
void read_measured(StudyInput& input, const std::vector<DataText>* kept,
                   const ReadEarlierRun& earlier, Diagnostics& diagnostics);

}  // namespace linkstudy
