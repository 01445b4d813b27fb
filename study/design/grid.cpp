#include "study/design/grid.h"

#include <fmt/core.h>

#include <stdexcept>

#include "study/record/sequence.h"

namespace linkstudy {

std::uint64_t count_grid(const std::vector<Axis>& axes) {
  std::uint64_t count = 1;
  for (const Axis& axis : axes) {
    const std::uint64_t size = axis.values.size();
    if (size > kMaxPoints / count)
      throw std::invalid_argument(
          fmt::format("grid: {} x {} points (up to '{}') are more than the {} allowed; use fewer "
                      "values, or design = \"list\"",
                      count, size, axis.parameter.path, kMaxPoints));
    count *= size;
  }
  return count;
}

Point make_grid_point(const std::vector<Axis>& axes, std::uint64_t id) {
  Point point{id, std::vector<Value>(axes.size())};
  std::uint64_t rest = id;
  for (std::size_t i = axes.size(); i-- > 0;) {
    const std::uint64_t size = axes[i].values.size();
    point.values[i] = axes[i].values[rest % size];
    rest /= size;
  }
  return point;
}

}  // namespace linkstudy
