// What runs keep of their steps, before they run: more than the machine has would end the program,
// and every start after it.
#pragma once

#include <string>

#include "core/simulation/observers.h"

namespace linkstudy {

// Bytes of the series of a run to its end.
double sample_bytes(const Observers& observers);

// What runs side by side may keep: an eighth of the memory of this machine, in bytes.
double most_sample_bytes();

// Why a run that keeps so much is not begun; empty where it may be.
std::string refuse_samples(double bytes);

}  // namespace linkstudy
