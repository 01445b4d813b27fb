// Which time histories a page opens with, over what, and what is marked there: decided here, drawn
// by the page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/page/moving_run.h"

namespace linkstudy {

// "closure.S.force" of "closure.S.force.x": what is drawn together.
std::string channel_group(const std::string& channel);

// A coordinate of a joint of the tree, "joint.A.q", "joint.U.q.1": others may be drawn over it.
bool is_coordinate(const std::string& channel);

// {"groups": names in the order of their weight (what was matched, forces of closures, closures,
//            the rest), "overs": what they can be drawn over,
//  "panels": [{"group", "over"}] that are open at first,
//  "marks": [{"name", "at": {over: value}}], the singular positions of a course}
// Without panels where no history has more than one instant.
nlohmann::ordered_json history_panels(const StudyResults& results, const MovingRuns& again,
                                      const std::vector<const TraceSet*>& histories);

}  // namespace linkstudy
