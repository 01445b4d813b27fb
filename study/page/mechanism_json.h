// The mechanism of a run as the page draws it: what is attached to every link and where, in link
// frames, and the poses of the links over time.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "study/page/moving_run.h"

namespace linkstudy {

// {"title", "load_case", "history": name of its histories, "ended",
//  "driven": channels that a course drives,
//  "links": [{"name", "mass", "center",
//             "shape": [{"kind": "cylinder", "begin", "end", "diameter"},
//                       {"kind": "box", "sides", "frame"},
//                       {"kind": "sphere", "diameter", "frame"}], in the link frame; of a flexible
//             link all are with the element of its own joint, unbent}],
//  "joints": [{"name", "type", "parent", "child", "parent_frame", "child_frame",
//              "bends": between two elements of a flexible link; unbent, its frames coincide}],
//  "closures": [{"name", "type", "model", "radial": clearance in m or null, "first", "second",
//                "first_frame", "second_frame"}],
//  "springs": [{"name", "first", "second", "first_position", "second_position"}],
//  "points": [{"name", "link", "position"}], "times", "poses"}
// Links are numbers in "links". A frame is [x, y, z, qw, qx, qy, qz]. Poses: 32-bit numbers in
// base64, seven a link as in a frame, link by link, instant by instant; m.
nlohmann::ordered_json mechanism_json(const MovingRun& run);

}  // namespace linkstudy
