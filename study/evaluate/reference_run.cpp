#include "study/evaluate/reference_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/config/precedence.h"
#include "study/evaluate/sample_memory.h"
#include "study/evaluate/step_sharing.h"
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

namespace {

// From the model of a load case to its record.
class ReferenceRun {
 public:
  ReferenceRun(const StudyInput& study, const LoadCaseInput& load_case)
      : input_(reference_view(study, load_case)),
        load_case_(load_case),
        model_(read_reference(input_, load_case)),
        preparation_(prepare(model_.linkage, model_.options)) {
    if (preparation_.cause != Cause::ok) fail(load_case, preparation_.cause, preparation_.message);
    const std::vector<Channel> all = list_channels(mechanism());
    Diagnostics diagnostics;
    signals_ = find_reference_signals(input_, all, diagnostics);
    if (!diagnostics.empty()) {
      fail(load_case, Cause::invalid_point, diagnostics.sorted().front().message);
    }
    grid_ = make_step_grid(model_.options);
    observers_ = make_observers(input_, signals_, all, grid_, model_.options.output_interval);
    watch_.emplace(input_, signals_, grid_, observers_);
    const std::string refused = refuse_samples(sample_bytes(observers_));
    if (!refused.empty()) fail(load_case, Cause::exception, refused);
  }
  ReferenceRun(const ReferenceRun&) = delete;
  ReferenceRun& operator=(const ReferenceRun&) = delete;

  const Mechanism& mechanism() const { return preparation_.model.mechanism; }
  const SimulationOptions& options() const { return model_.options; }

  bool can_share(const ReferenceRun& other) const {
    return can_share_steps({preparation_.model, model_.options, observers_},
                           {other.preparation_.model, other.model_.options, other.observers_});
  }

  BatchCase make_case() {
    const Model& model = preparation_.model;
    return {&model.parameters,
            &model.start,
            &observers_,
            {},
            worse({}, preparation_.spectrum, model.start.t)};
  }

  ReferenceRecord finish(const SimulationOutcome& outcome) {
    if (outcome.cause != Cause::ok) fail(load_case_, outcome.cause, outcome.message);
    ReferenceRecord record;
    record.warnings = preparation_.warnings;
    record.grid = grid_;
    record.responses =
        reduce_responses(input_, signals_, *watch_, observers_, model_.options.end_time);
    std::vector<Series>& series = observers_.series;
    series.resize(series.size() - watch_->series_count());
    record.joints = mechanism().joint_names;
    record.poses = to_states(series.back(), mechanism());
    series.pop_back();
    record.traces = to_traces(series.back());
    series.pop_back();
    record.cycles = find_cycles(input_, load_case_, series, grid_);
    series.resize(input_.match.size());
    record.match = std::move(series);
    return record;
  }

 private:
  const StudyInput input_;
  const LoadCaseInput& load_case_;
  const ModelInput model_;
  const Preparation preparation_;
  StudySignals signals_;
  StepGrid grid_{};
  Observers observers_;
  std::optional<ResponseWatch> watch_;
};

}  // namespace

std::vector<ReferenceRecord> run_references(const StudyInput& study,
                                            std::span<const LoadCaseInput* const> load_cases,
                                            const RunLimits& limits) {
  std::vector<std::unique_ptr<ReferenceRun>> runs;
  for (const LoadCaseInput* one : load_cases) {
    runs.push_back(std::make_unique<ReferenceRun>(study, *one));
  }
  std::vector<SimulationOutcome> outcomes(runs.size());
  const auto can_share = [](const ReferenceRun& a, const ReferenceRun& b) {
    return a.can_share(b);
  };
  for (const std::vector<std::size_t>& group : group_alike(runs, can_share)) {
    std::vector<BatchCase> cases;
    for (const std::size_t i : group) cases.push_back(runs[i]->make_case());
    const ReferenceRun& first = *runs[group.front()];
    simulate_batch(first.mechanism(), first.options(), cases, limits);
    for (std::size_t k = 0; k < group.size(); ++k) outcomes[group[k]] = cases[k].outcome;
  }
  std::vector<ReferenceRecord> records;
  for (std::size_t i = 0; i < runs.size(); ++i) records.push_back(runs[i]->finish(outcomes[i]));
  return records;
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
