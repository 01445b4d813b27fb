#include "study/plan/run_kinds.h"

#include <algorithm>

#include "core/model/compile.h"
#include "study/evaluate/form_packs.h"
#include "study/metrics/invalid_point.h"

namespace linkstudy::plan {
namespace {

constexpr std::size_t kMostLookedAt = 2000;

bool takes_as_long(const RunKind& a, const RunKind& b) {
  return a.load_case == b.load_case && shares_steps(a, b);
}

}  // namespace

bool shares_steps(const RunKind& a, const RunKind& b) {
  return a.options == b.options && same_structure(a.structure, b.structure);
}

RunKinds::RunKinds(const Evaluator& evaluator, const std::vector<Point>& points) {
  std::map<std::vector<Value>, const Point*> alike;
  for (const Point& point : points) {
    const auto [at, is_new] = alike.emplace(deciding_values(point, evaluator.parameters()), &point);
    const bool looks = is_new || by_point_.size() < kMostLookedAt;
    std::vector<std::size_t> kinds = looks ? find(evaluator, point) : of(*at->second);
    if (kinds.empty()) ++invalid_;
    for (const std::size_t kind : kinds) kinds_[kind].points.push_back(&point);
    by_point_.emplace(point.id, std::move(kinds));
  }
}

std::vector<std::size_t> RunKinds::find(const Evaluator& evaluator, const Point& point) {
  std::vector<std::size_t> kinds;
  try {
    for (std::size_t i = 0; i < evaluator.load_case_count(); ++i) {
      const ModelInput model = evaluator.model_at(i, point.values);
      kinds.push_back(find_kind(
          {i, model.options, compile(model.linkage).mechanism, make_step_grid(model.options)}));
    }
  } catch (const InvalidPoint&) {
    return {};  // the study notes it, in no time
  }
  return kinds;
}

std::size_t RunKinds::find_kind(RunKind wanted) {
  const auto found = std::ranges::find_if(
      kinds_, [&](const RunKind& known) { return takes_as_long(known, wanted); });
  const auto index = static_cast<std::size_t>(found - kinds_.begin());
  if (found == kinds_.end()) kinds_.push_back(std::move(wanted));
  return index;
}

}  // namespace linkstudy::plan
