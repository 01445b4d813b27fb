// The texts of `linkstudy describe channels [MODEL]`: names, units, frames, points and signs.
#pragma once

#include <string>

#include "core/model/mechanism.h"

namespace linkstudy {

// The patterns of names of any model.
std::string channel_patterns_text();

// Every channel of one.
std::string channels_text(const Mechanism& mechanism);

}  // namespace linkstudy
