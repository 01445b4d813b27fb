// A model file whose joints begin where a run of it began.
#pragma once

#include <string>

#include "core/model/compile.h"
#include "study/config/model_reader.h"

namespace linkstudy {

// The resolved input with `initial.position` and `.velocity` of every joint as they are in
// `started` (assembled, at equilibrium where that was asked for), to the last bit; flexible links
// with `flexible.initial`.
std::string started_model_text(const ModelInput& input, const Model& started);

}  // namespace linkstudy
