// Whether the runs of a study can be seen where it looks at them: windows within the runs and with
// an instant in them, steps of cases and reference on a common grid. Judged for the cases that
// occur (a selection of many, case_selection.h), in every load case; of a tune at its step and at
// the half of it that the certificate takes.
#pragma once

#include "study/config/study_input.h"

namespace linkstudy {

void check_times(const StudyInput& input, Diagnostics& diagnostics);

}  // namespace linkstudy
