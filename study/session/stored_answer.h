// What a verb concluded from stored evaluations.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "study/store/results.h"

namespace linkstudy {

// The object of its --json, or null.
nlohmann::json stored_answer(const StudyResults& results);

}  // namespace linkstudy
