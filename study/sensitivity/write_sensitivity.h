// Sensitivities as one JSON object, on one line; NaN is null.
#pragma once

#include <string>

#include "study/sensitivity/sensitivity.h"

namespace linkstudy::sensitivity {

std::string write_json(const Sensitivity& result);

}  // namespace linkstudy::sensitivity
