// What an entry still takes on so many ranks, by the forecast of `plan` from half a second of
// probes, less what its journal has: of a search what is certain of it, so that less than this is
// never enough. Reference runs that measure something are made once for it.
#pragma once

#include "study/config/study_input.h"
#include "study/queue/queue_folder.h"

namespace linkstudy::queue {

// s. Nothing where it cannot be told: whoever runs the entry says why. `at_most`: s that a single
// run may take.
std::optional<double> time_needed(const Entry& entry, const StudyInput& input, int ranks,
                                  double at_most);

}  // namespace linkstudy::queue
