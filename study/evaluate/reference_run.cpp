#include "study/evaluate/reference_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/precedence.h"

namespace linkstudy {
namespace {

std::string title_of(const LoadCaseInput& load_case) {
  return load_case.name.empty()
             ? "the reference run"
             : fmt::format("the reference run of {} '{}'",
                           load_case.measured ? "experiment" : "load case", load_case.name);
}

[[noreturn]] void fail(const LoadCaseInput& load_case, Cause cause, const std::string& message) {
  throw ReferenceFailure(
      cause, fmt::format("{} failed ({}): {}", title_of(load_case), name_of(cause), message));
}

std::vector<Channel> coordinate_channels(const std::vector<Channel>& all) {
  std::vector<Channel> channels = {time_channel()};
  for (const Channel& channel : all) {
    if (channel.quantity == Quantity::q || channel.quantity == Quantity::v) {
      channels.push_back(channel);
    }
  }
  return channels;
}

std::vector<State<double>> to_states(const Series& series, const Mechanism& mechanism) {
  std::vector<State<double>> states;
  for (std::size_t row = 1; row < series.rows(); ++row) {
    states.push_back(state_at(series, mechanism, row));
  }
  return states;
}

// Series: one per match, the histories, the poses. Reductions: of the responses, one by one.
Observers make_observers(const StudyInput& input, const StudySignals& signals,
                         const std::vector<Channel>& all, const StepGrid& grid,
                         double output_interval) {
  Observers observers;
  for (std::size_t i = 0; i < input.response.size(); ++i) {
    for (ChannelReduction& one : make_reductions(input.response[i], signals.response[i], grid)) {
      observers.reductions.push_back(std::move(one));
    }
  }
  for (const std::vector<Channel>& channels : signals.match) {
    observers.series.push_back({channels, {0, grid.count, 1}, {}});
  }
  observers.series.push_back(make_histories(signals.trace, grid, output_interval));
  const long stride = std::max(1L, grid.count / kReferencePoses);
  observers.series.push_back({coordinate_channels(all), {0, grid.count, stride}, {}});
  return observers;
}

// Those whose window ends with the run or before.
std::vector<Trace> reduce_responses(const StudyInput& input, const StudySignals& signals,
                                    const std::vector<ChannelReduction>& reductions,
                                    double end_time) {
  std::vector<Trace> responses;
  std::size_t at = 0;
  for (std::size_t i = 0; i < input.response.size(); ++i) {
    const ResponseInput& response = input.response[i];
    const bool is_whole = !response.window || response.window->last <= end_time * (1.0 + 1e-9);
    for (const Channel& channel : signals.response[i]) {
      const double value = reduce_channel(reductions[at++], response.reduce);
      if (is_whole) responses.push_back({response_name(response, channel), channel.unit, {value}});
    }
  }
  return responses;
}

}  // namespace

ModelInput read_reference(const StudyInput& view, const LoadCaseInput& load_case) {
  Diagnostics diagnostics;
  std::optional<ModelInput> model =
      view.reference->model->with(reference_overrides(view, load_case), diagnostics);
  if (model) return std::move(*model);
  const Diagnostic first = diagnostics.sorted().front();
  throw ReferenceFailure(Cause::invalid_point, to_string(first));
}

StudyInput reference_view(const StudyInput& input, const LoadCaseInput& load_case) {
  StudyInput view = input;
  if (!load_case.reference || !load_case.measured) return view;
  view.reference = load_case.reference;
  view.match.clear();
  for (const TraceInput& signal : load_case.measured->signals) {
    MatchInput& match = view.match.emplace_back();
    match.signal = match.reference_signal = signal.signal;
    match.at = match.reference_at = signal.at;
  }
  return view;
}

ReferenceRecord run_reference(const StudyInput& study, const LoadCaseInput& load_case,
                              const RunLimits& limits) {
  const StudyInput input = reference_view(study, load_case);
  const ModelInput model = read_reference(input, load_case);
  Preparation preparation = prepare(model.linkage, model.options);
  if (preparation.cause != Cause::ok) fail(load_case, preparation.cause, preparation.message);
  const Mechanism& mechanism = preparation.model.mechanism;
  const std::vector<Channel> all = list_channels(mechanism);
  Diagnostics diagnostics;
  const StudySignals signals = find_reference_signals(input, all, diagnostics);
  if (!diagnostics.empty()) {
    fail(load_case, Cause::invalid_point, diagnostics.sorted().front().message);
  }
  ReferenceRecord record;
  record.warnings = preparation.warnings;
  record.grid = make_step_grid(model.options);
  Observers observers =
      make_observers(input, signals, all, record.grid, model.options.output_interval);
  const SimulationOutcome outcome =
      simulate(mechanism, preparation.model.parameters, preparation.model.start, model.options,
               observers, limits, worse({}, preparation.spectrum, preparation.model.start.t));
  if (outcome.cause != Cause::ok) fail(load_case, outcome.cause, outcome.message);
  record.joints = mechanism.joint_names;
  record.poses = to_states(observers.series.back(), mechanism);
  observers.series.pop_back();
  record.traces = to_traces(observers.series.back());
  observers.series.pop_back();
  record.match = std::move(observers.series);
  record.responses = reduce_responses(input, signals, observers.reductions, model.options.end_time);
  return record;
}

KnownLimit find_known_limit(const Preparation& preparation, const ReferenceRecord* reference) {
  const Model& model = preparation.model;
  KnownLimit known{worse({}, preparation.spectrum, model.start.t)};
  if (reference == nullptr || reference->joints != model.mechanism.joint_names) return known;
  for (const State<double>& pose : reference->poses) {
    const bool fits = pose.q.size() == model.start.q.size() &&
                      pose.v.size() == model.start.v.size() &&
                      pose.z.size() == model.start.z.size();  // bristles of clearances
    if (!fits) break;
    known.worst = worse(known.worst, compute_spectrum(model, pose), pose.t);
    known.along = true;
  }
  return known;
}

}  // namespace linkstudy
