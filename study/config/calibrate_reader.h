// What the tables of a calibration say beyond their rows: roles and ranges of parameters in the
// units of the model, and what experiments are compared with.
#pragma once

#include "study/config/study_cases.h"
#include "study/config/study_input.h"

namespace linkstudy {

// Fills input.calibrated from [[parameter]] of the validated tree, and for each the values it can
// have, as written. `document`: the model as base.set leaves it.
WrittenValues read_calibrated(const ModelDocument& document, Tree& study, StudyInput& input,
                              Diagnostics& diagnostics);

// What experiments and their keys lack.
void check_experiments(const StudyInput& input, Diagnostics& diagnostics);

}  // namespace linkstudy
