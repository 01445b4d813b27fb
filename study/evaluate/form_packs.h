// Which points are evaluated together, so that the lanes of a rank are filled and every rank has
// work. Packs are formed from the points alone, never from what arrives when; they change how fast
// a study is and nothing else.
#pragma once

#include <algorithm>
#include <vector>

#include "study/evaluate/evaluator.h"

namespace linkstudy {

// Values of a point that decide the structure or the steps: its words, segments of flexible links,
// and `simulation.*`.
std::vector<Value> deciding_values(const Point& point, const std::vector<Parameter>& parameters);

// How many points a rank is given at once: as many as it has lanes; of runs with steps of their own
// some more, since a lane whose run has ended takes the next. Of others as many as run at once
// (packs_beside), while every rank still has so many packs to do that none waits long for the last.
int pack_width(const Evaluator& evaluator, const std::vector<Point>& points, int lanes, int ranks);

//   size = min(width, max(1, ceil(count / ranks)))
std::size_t pack_size(std::size_t count, int width, int ranks);

// In the order given, `size` at a time.
template <class Item>
std::vector<std::vector<Item>> split(const std::vector<Item>& all, std::size_t size) {
  std::vector<std::vector<Item>> parts;
  for (std::size_t i = 0; i < all.size(); i += size) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(i);
    parts.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(std::min(size, all.size() - i)));
  }
  return parts;
}

// Points in the order given, apart from this: only those that agree in these values come together,
// for others rarely fit into one step loop.
std::vector<std::vector<Point>> form_packs(const std::vector<Point>& points,
                                           const std::vector<Parameter>& parameters, int width,
                                           int ranks);

}  // namespace linkstudy
