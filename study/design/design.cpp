#include "study/design/design.h"

#include <array>
#include <cstddef>

#include "study/design/grid.h"
#include "study/design/list.h"

namespace linkstudy {
namespace {

struct Kind {
  std::uint64_t (*count)(const std::vector<Axis>& axes);
  Point (*make)(const std::vector<Axis>& axes, std::uint64_t id);
};

// The only list of designs, in the order of the enumeration.
constexpr std::array<Kind, kWords<Design>.size()> kKinds = {{
    {count_grid, make_grid_point},
    {count_list, make_list_point},
}};

const Kind& kind_of(Design design) {
  return kKinds[static_cast<std::size_t>(design)];
}

}  // namespace

std::uint64_t count_points(Design design, const std::vector<Axis>& axes) {
  check_axes(axes);
  return kind_of(design).count(axes);
}

Point make_point(Design design, const std::vector<Axis>& axes, std::uint64_t id) {
  return kind_of(design).make(axes, id);
}

std::vector<Point> make_points(Design design, const std::vector<Axis>& axes) {
  const std::uint64_t count = count_points(design, axes);
  std::vector<Point> points;
  points.reserve(count);
  for (std::uint64_t id = 0; id < count; ++id) points.push_back(make_point(design, axes, id));
  return points;
}

}  // namespace linkstudy
