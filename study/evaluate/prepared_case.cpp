#include "study/evaluate/prepared_case.h"

#include "study/evaluate/step_sharing.h"

namespace linkstudy {
namespace {

StepRun run_of(const PreparedCase& item) {
  return {item.preparation.model, item.options, item.metrics.observers()};
}

}  // namespace

std::vector<CaseGroup> group_cases(const std::vector<std::unique_ptr<PreparedCase>>& cases) {
  const auto can_share = [](const PreparedCase& a, const PreparedCase& b) {
    return can_share_steps(run_of(a), run_of(b));
  };
  std::vector<CaseGroup> groups;
  for (const std::vector<std::size_t>& alike : group_alike(cases, can_share)) {
    CaseGroup& group = groups.emplace_back();
    for (const std::size_t i : alike) group.push_back(cases[i].get());
  }
  return groups;
}

void run_cases(const CaseGroup& group, const RunLimits& limits) {
  std::vector<BatchCase> cases;
  for (PreparedCase* item : group) {
    const Model& model = item->preparation.model;
    cases.push_back({&model.parameters,
                     &model.start,
                     &item->metrics.observers(),
                     {},
                     item->limit.worst,
                     item->limit.along});
  }
  const PreparedCase& first = *group.front();
  simulate_batch(first.preparation.model.mechanism, first.options, cases, limits);
  for (std::size_t i = 0; i < group.size(); ++i) group[i]->outcome = std::move(cases[i].outcome);
}

}  // namespace linkstudy
