#include "study/design/centered.h"

#include <fmt/core.h>

#include <stdexcept>

#include "study/record/sequence.h"

namespace linkstudy {

std::uint64_t count_centered(const std::vector<Axis>& axes) {
  std::uint64_t count = 1;
  for (const Axis& axis : axes) count += axis.values.size() - 1;
  if (count <= kMaxPoints) return count;
  throw std::invalid_argument(
      fmt::format("centered: {} points are more than the {} allowed", count, kMaxPoints));
}

Point make_centered_point(const std::vector<Axis>& axes, std::uint64_t id) {
  Point point{id, {}};
  for (const Axis& axis : axes) point.values.push_back(axis.values.at(axis.center));
  if (id == 0) return point;
  std::uint64_t rest = id - 1;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::uint64_t others = axes[i].values.size() - 1;
    if (rest < others) {
      point.values[i] = axes[i].values[rest < axes[i].center ? rest : rest + 1];
      return point;
    }
    rest -= others;
  }
  throw std::out_of_range(fmt::format("centered: there is no point {}", id));
}

}  // namespace linkstudy
