#include "study/evaluate/form_packs.h"

#include <algorithm>
#include <map>

#include "core/simulation/simulate.h"
#include "study/metrics/invalid_point.h"

namespace linkstudy {
namespace {

constexpr int kRefills = 4;
constexpr int kLeastPacks = 8;  // of a rank: the last is late by so small a part, if at all

// In the order of their first points.
std::vector<std::vector<Point>> sort_by_kind(const std::vector<Point>& points,
                                             const std::vector<Parameter>& parameters) {
  std::vector<std::vector<Point>> kinds;
  std::map<std::vector<Value>, std::size_t> known;
  for (const Point& point : points) {
    const auto [at, is_new] = known.emplace(deciding_values(point, parameters), kinds.size());
    if (is_new) kinds.emplace_back();
    kinds[at->second].push_back(point);
  }
  return kinds;
}

}  // namespace

std::vector<Value> deciding_values(const Point& point, const std::vector<Parameter>& parameters) {
  std::vector<Value> values;
  for (std::size_t i = 0; i < parameters.size() && i < point.values.size(); ++i) {
    const std::string& path = parameters[i].path;
    const bool is_word = std::holds_alternative<std::string>(point.values[i]);
    const bool is_structure = path.ends_with(".segments");
    if (is_word || is_structure || path.starts_with("simulation.")) {
      values.push_back(point.values[i]);
    }
  }
  return values;
}

int pack_width(const Evaluator& evaluator, const std::vector<Point>& points, int lanes, int ranks) {
  try {
    const ModelInput model = evaluator.model_at(0, points.front().values);
    if (lanes == 1) return lanes;
    if (model.options.integrator == Integrator::adaptive) return kRefills * lanes;
    const int beside = packs_beside(simd_level()) * lanes;
    const bool is_plenty = points.size() >= static_cast<std::size_t>(kLeastPacks * beside * ranks);
    return is_plenty ? beside : lanes;
  } catch (const InvalidPoint&) {
    return lanes;
  }
}

std::size_t pack_size(std::size_t count, int width, int ranks) {
  const auto shares = static_cast<std::size_t>(std::max(1, ranks));
  return std::clamp((count + shares - 1) / shares, std::size_t{1}, static_cast<std::size_t>(width));
}

std::vector<std::vector<Point>> form_packs(const std::vector<Point>& points,
                                           const std::vector<Parameter>& parameters, int width,
                                           int ranks) {
  const std::size_t size = pack_size(points.size(), width, ranks);
  std::vector<std::vector<Point>> packs;
  for (const std::vector<Point>& kind : sort_by_kind(points, parameters))
    for (std::vector<Point>& pack : split(kind, size)) packs.push_back(std::move(pack));
  return packs;
}

}  // namespace linkstudy
