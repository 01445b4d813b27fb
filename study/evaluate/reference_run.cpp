#include "study/evaluate/reference_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/precedence.h"
#include "study/metrics/cycle.h"

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

// Series: one per match, one per cycle of a match, the histories, the poses.
Observers make_observers(const StudyInput& input, const StudySignals& signals,
                         const std::vector<Channel>& all, const StepGrid& grid,
                         double output_interval) {
  Observers observers;
  for (const std::vector<Channel>& channels : signals.match) {
    observers.series.push_back({channels, {0, grid.count, 1}, {}});
  }
  for (std::size_t i = 0; i < input.match.size(); ++i) {
    if (!input.match[i].cycle) continue;
    observers.series.push_back({signals.match_cycle[i], {0, grid.count, 1}, {}});
  }
  observers.series.push_back(make_histories(signals.trace, grid, output_interval));
  const long stride = std::max(1L, grid.count / kReferencePoses);
  observers.series.push_back({coordinate_channels(all), {0, grid.count, stride}, {}});
  return observers;
}

// Those whose window ends with the run or before, and whose turns are there.
std::vector<Trace> reduce_responses(const StudyInput& input, const StudySignals& signals,
                                    const ResponseWatch& watch, const Observers& observers,
                                    double end_time) {
  std::vector<Trace> responses;
  const std::vector<std::vector<double>> numbers = watch.reduce(observers);
  for (std::size_t i = 0; i < input.response.size(); ++i) {
    const ResponseInput& response = input.response[i];
    const bool is_whole = !response.window || response.window->last <= end_time * (1.0 + 1e-9);
    for (std::size_t c = 0; is_whole && c < signals.response[i].size(); ++c) {
      const Channel& channel = signals.response[i][c];
      responses.push_back({response_name(response, channel), channel.unit, {numbers[i][c]}});
    }
  }
  return responses;
}

// By [[match]]; the angles are the series behind those of the matches.
std::vector<TimeWindow> find_cycles(const StudyInput& input, const LoadCaseInput& load_case,
                                    const std::vector<Series>& series, const StepGrid& grid) {
  std::vector<TimeWindow> cycles;
  std::size_t next = input.match.size();
  for (std::size_t i = 0; i < input.match.size(); ++i) {
    if (!input.match[i].cycle) continue;
    const CycleInput& cycle = *input.match[i].cycle;
    const Series& angle = series[next++];
    const std::optional<TimeWindow> window = find_cycle(cycle, angle, grid.h);
    if (!window) fail(load_case, Cause::no_full_turn, no_cycle_text(cycle, angle));
    cycles.resize(input.match.size());
    cycles[i] = *window;
  }
  return cycles;
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
  const ResponseWatch watch(input, signals, record.grid, observers);
  const SimulationOutcome outcome =
      simulate(mechanism, preparation.model.parameters, preparation.model.start, model.options,
               observers, limits, worse({}, preparation.spectrum, preparation.model.start.t));
  if (outcome.cause != Cause::ok) fail(load_case, outcome.cause, outcome.message);
  record.responses = reduce_responses(input, signals, watch, observers, model.options.end_time);
  observers.series.resize(observers.series.size() - watch.series_count());
  record.joints = mechanism.joint_names;
  record.poses = to_states(observers.series.back(), mechanism);
  observers.series.pop_back();
  record.traces = to_traces(observers.series.back());
  observers.series.pop_back();
  record.cycles = find_cycles(input, load_case, observers.series, record.grid);
  observers.series.resize(input.match.size());
  record.match = std::move(observers.series);
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
