#include "study/design/design.h"

#include <array>
#include <cstddef>

#include "study/design/grid.h"
#include "study/design/list.h"

namespace linkstudy {
namespace {

struct Kind {
  Design design;
  std::string_view name;
  std::uint64_t (*count)(const std::vector<Axis>& axes);
  Point (*make)(const std::vector<Axis>& axes, std::uint64_t id);
};

// The only list of designs, in the order of the enumeration.
constexpr std::array<Kind, 2> kinds = {{
    {Design::list, "list", count_list, make_list_point},
    {Design::grid, "grid", count_grid, make_grid_point},
}};

const Kind& kind_of(Design design) {
  return kinds[static_cast<std::size_t>(design)];
}

}  // namespace

std::string_view design_name(Design design) {
  return kind_of(design).name;
}

std::optional<Design> find_design(std::string_view name) {
  for (const Kind& kind : kinds)
    if (kind.name == name) return kind.design;
  return std::nullopt;
}

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
