// The keys that a calibration adds to those of all files that vary a model.
#pragma once

#include "study/config/fields.h"
#include "study/config/study_input.h"

namespace linkstudy {

// [[parameter]], [[experiment]], [fit].
Fields<StudyInput> calibration_fields();

// Columns of a CSV file: path of a channel = head.
void add_columns(Fields<MeasuredInput>& measured);

}  // namespace linkstudy
