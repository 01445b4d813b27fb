#include "study/evaluate/step_sharing.h"

#include <algorithm>

#include "core/simulation/simulate.h"
#include "study/metrics/study_signals.h"

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
    return same_series(x, y) && x.sign == y.sign && x.is_constant == y.is_constant;
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

}  // namespace

bool can_share_steps(const StepRun& a, const StepRun& b) {
  return same_steps(a.options, b.options) && a.model.start.t == b.model.start.t &&
         same_structure(a.model.mechanism, b.model.mechanism) &&
         a.model.mechanism.point_bodies == b.model.mechanism.point_bodies &&
         same_form(a.observers, b.observers);
}

}  // namespace linkstudy
