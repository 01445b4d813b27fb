#include "study/evaluate/prepared_case.h"

#include <algorithm>
#include <cmath>

namespace linkstudy {
namespace {

bool same_sampling(const Sampling& a, const Sampling& b) {
  return a.begin == b.begin && a.end == b.end && a.stride == b.stride;
}

bool same_form(const Observers& a, const Observers& b) {
  const auto same_series = [](const auto& x, const auto& y) {
    return same_channels(x.channels, y.channels) && same_sampling(x.sampling, y.sampling);
  };
  const auto same_comparison = [&](const auto& x, const auto& y) {
    return same_series(x, y) && x.sign == y.sign;
  };
  const auto same_reduction = [](const auto& x, const auto& y) {
    return same_channel(x.channel, y.channel) && same_channels(x.place, y.place) &&
           same_sampling(x.sampling, y.sampling);
  };
  return a.contacts.most == b.contacts.most &&
         std::ranges::equal(a.series, b.series, same_series) &&
         std::ranges::equal(a.comparisons, b.comparisons, same_comparison) &&
         std::ranges::equal(a.reductions, b.reductions, same_reduction);
}

long output_stride(const SimulationOptions& options, const StepGrid& grid) {
  return sample_output(grid, options.output_interval).stride;
}

bool same_steps(const SimulationOptions& a, const SimulationOptions& b) {
  const StepGrid grid_a = make_step_grid(a);
  const StepGrid grid_b = make_step_grid(b);
  return grid_a.count == grid_b.count && grid_a.h == grid_b.h && a.integrator == b.integrator &&
         a.relative_tolerance == b.relative_tolerance &&
         a.absolute_tolerance == b.absolute_tolerance && a.step_limit == b.step_limit &&
         a.drift_limit == b.drift_limit && output_stride(a, grid_a) == output_stride(b, grid_b);
}

bool can_share(const PreparedCase& a, const PreparedCase& b) {
  const Model& model_a = a.preparation.model;
  const Model& model_b = b.preparation.model;
  return same_steps(a.options, b.options) && model_a.start.t == model_b.start.t &&
         same_structure(model_a.mechanism, model_b.mechanism) &&
         model_a.mechanism.point_bodies == model_b.mechanism.point_bodies &&
         same_form(a.metrics.observers(), b.metrics.observers());
}

}  // namespace

std::vector<CaseGroup> group_cases(const std::vector<std::unique_ptr<PreparedCase>>& cases) {
  std::vector<CaseGroup> groups;
  for (const auto& item : cases) {
    const auto fits = [&](const CaseGroup& group) { return can_share(*group.front(), *item); };
    const auto found = std::ranges::find_if(groups, fits);
    if (found == groups.end()) {
      groups.push_back({item.get()});
    } else {
      found->push_back(item.get());
    }
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
