// Whether the runs of a study can be seen where it looks at them: windows within the runs and with
// an instant in them, steps of cases and reference on a common grid, measured instants within the
// run. Judged for the cases that occur (a selection of many, case_selection.h), in every load case;
// of a tune at its step and at the half of it that the certificate takes.
#pragma once

#include <memory>

#include "study/metrics/measured_match.h"

namespace linkstudy {

// By load case, null where that is not compared with data.
using MeasuredReferences = std::vector<std::shared_ptr<const MeasuredReference>>;

void check_times(const StudyInput& input, const MeasuredReferences& measured,
                 Diagnostics& diagnostics);

}  // namespace linkstudy
