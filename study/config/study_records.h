// The parts of a study that do not need its model: what is compared and kept, how it is run.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

// `study` is a validated tree; fills match, response, trace, search, run and design.
void read_records(const Tree& study, StudyInput& input, Diagnostics& diagnostics);

}  // namespace linkstudy
