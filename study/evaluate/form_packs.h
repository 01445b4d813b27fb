// Which points are evaluated together, so that the lanes of a rank are filled and every rank has
// work. Packs are formed from the points alone, never from what arrives when; they change how fast
// a study is and nothing else.
//   width = min(lanes, max(1, ceil(points / ranks)))
#pragma once

#include <vector>

#include "study/record/evaluation.h"

namespace linkstudy {

// Values of a point that decide the structure or the steps: its words, segments of flexible links,
// and `simulation.*`.
std::vector<Value> deciding_values(const Point& point, const std::vector<Parameter>& parameters);

// Points in the order given, apart from this: only those that agree in these values come together,
// for others rarely fit into one step loop.
std::vector<std::vector<Point>> form_packs(const std::vector<Point>& points,
                                           const std::vector<Parameter>& parameters, int lanes,
                                           int ranks);

}  // namespace linkstudy
