// Which points are evaluated together, so that the lanes of a rank are filled and every rank has
// work. Packs are formed from the points alone, never from what arrives when; they change how fast
// a study is and nothing else.
//   width = min(width, max(1, ceil(points / ranks)))
#pragma once

#include <vector>

#include "study/evaluate/evaluator.h"

namespace linkstudy {

// Values of a point that decide the structure or the steps: its words, segments of flexible links,
// and `simulation.*`.
std::vector<Value> deciding_values(const Point& point, const std::vector<Parameter>& parameters);

// How many points a rank is given at once: as many as it has lanes; of runs with steps of their own
// some more, since a lane whose run has ended takes the next.
int pack_width(const Evaluator& evaluator, const Point& first, int lanes);

// Points in the order given, apart from this: only those that agree in these values come together,
// for others rarely fit into one step loop.
std::vector<std::vector<Point>> form_packs(const std::vector<Point>& points,
                                           const std::vector<Parameter>& parameters, int width,
                                           int ranks);

}  // namespace linkstudy
