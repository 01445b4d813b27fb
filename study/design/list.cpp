#include "study/design/list.h"

#include <fmt/core.h>

#include <stdexcept>

#include "study/record/sequence.h"

namespace linkstudy {

std::uint64_t count_list(const std::vector<Axis>& axes) {
  if (axes.empty()) return 1;
  const Axis& first = axes.front();
  for (const Axis& axis : axes)
    if (axis.values.size() != first.values.size())
      throw std::invalid_argument(fmt::format(
          "list: '{}' has {} values but '{}' has {}; give as many, or use design = \"grid\"",
          axis.parameter.path, axis.values.size(), first.parameter.path, first.values.size()));
  if (first.values.size() > kMaxPoints)
    throw std::invalid_argument(fmt::format("list: {} points are more than the {} allowed",
                                            first.values.size(), kMaxPoints));
  return first.values.size();
}

Point make_list_point(const std::vector<Axis>& axes, std::uint64_t id) {
  Point point{id, {}};
  point.values.reserve(axes.size());
  for (const Axis& axis : axes) point.values.push_back(axis.values[id]);
  return point;
}

}  // namespace linkstudy
