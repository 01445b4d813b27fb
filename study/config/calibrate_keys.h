// The keys that a calibration adds to those of all files that vary a model.
#pragma once

#include "study/config/fields.h"
#include "study/config/study_input.h"

namespace linkstudy {

// [[parameter]], [[experiment]], [fit].
Fields<StudyInput> calibration_fields();

}  // namespace linkstudy
