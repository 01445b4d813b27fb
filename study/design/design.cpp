#include "study/design/design.h"

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <stdexcept>

#include "study/design/centered.h"
#include "study/design/grid.h"
#include "study/design/list.h"
#include "study/design/samples.h"
#include "study/record/sequence.h"

namespace linkstudy {
namespace {

using Axes = std::vector<Axis>;

struct Kind {
  // Of values.
  std::uint64_t (*count)(const Axes& axes) = nullptr;
  Point (*make)(const Axes& axes, std::uint64_t id) = nullptr;
  // Of samples.
  std::uint64_t DesignOptions::*blocks = nullptr;
  std::vector<double> (*unit)(const DesignOptions& design, std::size_t k,
                              std::uint64_t id) = nullptr;
  bool needs_sequence = false;  // of Sobol
};

// The only list of designs, in the order of the enumeration.
constexpr std::array<Kind, kWords<Design>.size()> kKinds = {{
    {count_grid, make_grid_point},
    {count_list, make_list_point},
    {count_centered, make_centered_point},
    {count_list, make_list_point},  // vector: the steps of all are as many
    {.blocks = &DesignOptions::samples, .unit = latin_hypercube_point},
    {.blocks = &DesignOptions::samples, .unit = sobol_point, .needs_sequence = true},
    {.blocks = &DesignOptions::trajectories, .unit = morris_point},
    {.blocks = &DesignOptions::samples, .unit = saltelli_point, .needs_sequence = true},
}};

const Kind& kind_of(const DesignOptions& design) {
  return kKinds[static_cast<std::size_t>(design.type)];
}

std::uint64_t count_samples(const DesignOptions& design, std::size_t k) {
  const std::uint64_t blocks = design.*kind_of(design).blocks;
  const std::uint64_t size = block_size(design.type, k);
  const auto name = name_of(design.type);
  if (k == 0)
    throw std::invalid_argument(
        fmt::format("{}: there is nothing to sample; name a parameter with its range", name));
  const std::size_t numbers = design.type == Design::saltelli ? 2 * k : k;
  if (kind_of(design).needs_sequence && numbers > kMostSobolParameters)
    throw std::invalid_argument(
        fmt::format("{}: points of {} numbers are longer than those of the Sobol sequence, {}; "
                    "vary fewer parameters",
                    name, numbers, kMostSobolParameters));
  if (blocks > kMaxPoints / size)
    throw std::invalid_argument(
        fmt::format("{}: {} x {} points are more than the {} allowed; use "
                    "fewer",
                    name, blocks, size, kMaxPoints));
  return blocks * size;
}

}  // namespace

std::uint64_t count_points(const DesignOptions& design, const Axes& axes) {
  check_axes(axes, is_sampled(design.type));
  if (is_sampled(design.type)) return count_samples(design, axes.size());
  return kind_of(design).count(axes);
}

std::vector<double> make_unit_point(const DesignOptions& design, std::size_t parameters,
                                    std::uint64_t id) {
  return kind_of(design).unit(design, parameters, id);
}

Point make_point(const DesignOptions& design, const Axes& axes, std::uint64_t id) {
  if (!is_sampled(design.type)) return kind_of(design).make(axes, id);
  const std::vector<double> u = make_unit_point(design, axes.size(), id);
  Point point{id, {}};
  point.values.reserve(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    point.values.emplace_back(quantile(*axes[i].distribution, u[i]));
  }
  return point;
}

std::vector<Point> make_points(const DesignOptions& design, const Axes& axes) {
  const std::uint64_t count = count_points(design, axes);
  std::vector<Point> points;
  points.reserve(count);
  for (std::uint64_t id = 0; id < count; ++id) points.push_back(make_point(design, axes, id));
  return points;
}

}  // namespace linkstudy
