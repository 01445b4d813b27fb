// What a reader wants to see first: one row an evaluation and load case, with the parameters that
// vary, the damping in SI units where it is given as a ratio, of every match the largest errors in
// percent and the component that has them, [[response]], gap, step limit and status.
#pragma once

#include "study/store/results.h"

namespace linkstudy {

Table summary_table(const StudyResults& results);

}  // namespace linkstudy
