#include "study/session/single_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/simulation/channel_kinds.h"
#include "core/topology/nearest_name.h"
#include "study/config/input_error.h"
#include "study/metrics/run_metrics.h"
#include "study/report/choose_table.h"
#include "study/schedule/run_progress.h"

namespace linkstudy {
namespace {

// Time first, then all channels or those of --signals in the order asked for.
std::vector<Channel> choose_channels(const std::vector<Channel>& all,
                                     const std::optional<std::string>& signals) {
  if (!signals) return all;
  std::vector<Channel> chosen = {time_channel()};
  for (const std::string& signal : split_list(*signals)) {
    const std::vector<Channel> found = find_channel_group(all, signal);
    if (found.empty()) {
      std::vector<std::string> names = signal_names(all);
      for (const Channel& channel : all) names.push_back(channel.name);
      throw UsageError(fmt::format("--signals: there is no '{}'; nearest: {}", signal,
                                   fmt::join(nearest_names(signal, names, 3), ", ")));
    }
    for (const Channel& channel : found) {
      const bool is_known = std::ranges::any_of(
          chosen, [&](const Channel& other) { return other.name == channel.name; });
      if (!is_known) chosen.push_back(channel);
    }
  }
  return chosen;
}

}  // namespace

Series choose_series(const ModelInput& input, const std::optional<std::string>& signals) {
  const std::vector<Channel> all = list_channels(compile(input.linkage).mechanism);
  const Sampling sampling =
      sample_output(make_step_grid(input.options), input.options.output_interval);
  return {choose_channels(all, signals), sampling, {}};
}

SimulationOutcome run_watched(const Preparation& preparation, const SimulationOptions& options,
                              Observers& observers, double timeout_s, ProgressMode progress) {
  const Model& model = preparation.model;
  std::atomic<double> reached{0.0};
  const RunWatch watch(progress, options.end_time, reached);
  RunLimits limits;
  limits.timeout_s = timeout_s;
  limits.reached = &reached;
  const SimulationOutcome outcome =
      simulate(model.mechanism, model.parameters, model.start, options, observers, limits,
               worse({}, preparation.spectrum, model.start.t));
  reached = outcome.end_time;
  return outcome;
}

}  // namespace linkstudy
