#include "study/evaluate/run_costs.h"

#include <algorithm>

#include "core/model/compile.h"
#include "core/simulation/simulate.h"
#include "study/evaluate/form_packs.h"
#include "study/metrics/invalid_point.h"

namespace linkstudy {
namespace {

constexpr std::size_t kMostKinds = 4000;

}  // namespace

double RunCosts::of(const std::vector<Point>& pack) {
  const auto count = static_cast<double>(pack.size());
  std::vector<Value> kind = deciding_values(pack.front(), evaluator_.parameters());
  const auto found = known_.find(kind);
  if (found != known_.end()) return count * found->second;
  if (known_.size() == kMostKinds) return count * sum_ / static_cast<double>(kMostKinds);
  const double cost = look_at(pack.front());
  known_.emplace(std::move(kind), cost);
  sum_ += cost;
  return count * cost;
}

double RunCosts::look_at(const Point& point) const {
  double cost = 0.0;
  try {
    for (std::size_t i = 0; i < evaluator_.load_case_count(); ++i) {
      const ModelInput model = evaluator_.model_at(i, point.values);
      const auto steps = static_cast<double>(make_step_grid(model.options).count);
      const auto freedoms = static_cast<double>(compile(model.linkage).mechanism.nv);
      cost += steps * freedoms * freedoms;
    }
  } catch (const InvalidPoint&) {
    return 0.0;  // noted in no time
  }
  return cost;
}

void sort_by_cost(std::vector<std::vector<Point>>& packs, RunCosts& costs) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < packs.size(); ++i) order.emplace_back(-costs.of(packs[i]), i);
  std::ranges::stable_sort(order, {}, &std::pair<double, std::size_t>::first);
  std::vector<std::vector<Point>> sorted;
  for (const auto& [cost, i] : order) sorted.push_back(std::move(packs[i]));
  packs = std::move(sorted);
}

}  // namespace linkstudy
