// The tables of a tuning as groups of the results file.
#pragma once

#include "study/store/data_group.h"
#include "study/tune/tuning_result.h"

namespace linkstudy {

DataGroup make_tuning_group(const tuning::TuningResult& result);

}  // namespace linkstudy
