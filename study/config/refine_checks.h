// What a refinement needs beyond its keys.
#pragma once

#include "study/config/study_cases.h"

namespace linkstudy {

// One ladder or two, of at least two positive numbers each; tolerances that are left to
// wanted_error; time histories that are compared are kept.
void finish_refinement(StudyInput& input, const WrittenValues& written, Diagnostics& diagnostics);

}  // namespace linkstudy
