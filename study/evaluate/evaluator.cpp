#include "study/evaluate/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/config/precedence.h"
#include "study/metrics/invalid_point.h"

namespace linkstudy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kOffsetPrefix = "experiment.";

// A model that is there, or the first thing that is wrong with it.
ModelInput require_model(const ModelDocument& document, const std::vector<Override>& set) {
  Diagnostics diagnostics;
  std::optional<ModelInput> model = document.with(set, diagnostics);
  if (model) return std::move(*model);
  throw InvalidPoint(diagnostics.sorted().front().message);
}

std::optional<std::vector<Channel>> read_channels(const ModelDocument& document,
                                                  const std::vector<Override>& set,
                                                  Diagnostics& diagnostics) {
  const std::optional<ModelInput> model = document.with(set, diagnostics);
  if (!model) return std::nullopt;
  return list_channels(compile(model->linkage).mechanism);
}

std::optional<StudySignals> check_study_signals(const StudyInput& input,
                                                const std::vector<Override>& first,
                                                Diagnostics& diagnostics) {
  const LoadCaseInput load_case = load_cases_of(input).front();
  const auto own =
      read_channels(*input.model, case_overrides(input, load_case, first), diagnostics);
  if (!own) return std::nullopt;
  StudySignals signals = find_case_signals(input, *own, diagnostics);
  for (const LoadCaseInput& one : load_cases_of(input)) {
    const ReferenceInput* run = one.measured ? nullptr : reference_run_of(input, one);
    if (run == nullptr) continue;
    const auto other = read_channels(*run->model, reference_overrides(input, one), diagnostics);
    if (!other) return std::nullopt;
    check_signals(input, signals, find_reference_signals(input, *other, diagnostics), diagnostics);
    break;  // the common one: its signals are the same in every load case
  }
  return signals;
}

std::vector<Override> to_overrides(const std::vector<Parameter>& parameters,
                                   const std::vector<Value>& point) {
  std::vector<Override> set;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (is_measured_offset(parameters[i].path)) continue;
    set.push_back(make_override(parameters[i].path, point.at(i)));
  }
  return set;
}

// Sets of all experiments with a file, in the order of the load cases; null for others.
std::vector<std::shared_ptr<const MeasuredSet>> make_file_sets(const StudyInput& input,
                                                               const std::vector<Override>& first,
                                                               Diagnostics& diagnostics) {
  std::vector<std::shared_ptr<const MeasuredSet>> sets;
  for (const LoadCaseInput& one : load_cases_of(input)) {
    sets.emplace_back();
    if (!one.measured || !one.measured->data) continue;
    const auto model = input.model->with(case_overrides(input, one, first), diagnostics);
    if (!model) continue;
    const std::vector<Channel> channels = list_channels(compile(model->linkage).mechanism);
    auto set = std::make_shared<MeasuredSet>(
        make_measured_set(*one.measured, *one.measured->data, channels, diagnostics));
    check_instants(*one.measured, *set, model->options.end_time, diagnostics);
    sets.back() = std::move(set);
  }
  return sets;
}

// What matches are compared with where that is data.
MeasuredReferences make_measured_references(const StudyInput& input,
                                            const std::vector<Override>& first,
                                            Diagnostics& diagnostics) {
  MeasuredReferences references;
  for (const LoadCaseInput& one : load_cases_of(input)) {
    references.emplace_back();
    const MeasuredInput* measured = reference_data_of(input, one);
    if (measured == nullptr || !measured->data) continue;
    const auto channels =
        read_channels(*input.model, case_overrides(input, one, first), diagnostics);
    if (!channels) continue;
    const StudySignals signals = find_case_signals(input, *channels, diagnostics);
    references.back() = std::make_shared<const MeasuredReference>(
        make_measured_reference(input, *measured, signals, diagnostics));
  }
  return references;
}

// Signals of a reference run that stands for measurements, and whether both runs reach them.
void check_reference_data(const StudyInput& input, const LoadCaseInput& one,
                          const std::vector<Override>& first, Diagnostics& diagnostics) {
  const auto own = input.model->with(case_overrides(input, one, first), diagnostics);
  const auto other = one.reference->model->with(reference_overrides(input, one), diagnostics);
  if (!own || !other) return;
  const std::vector<Channel> channels = list_channels(compile(other->linkage).mechanism);
  find_reference_signals(reference_view(input, one), channels, diagnostics);
  const std::optional<TimeWindow>& window = one.measured->window;
  const double last = window ? window->last : other->options.end_time;
  const double reached = std::min(own->options.end_time, other->options.end_time);
  if (last <= reached * (1.0 + 1e-9)) return;
  diagnostics.add(window ? window->at : one.reference->at,
                  fmt::format("experiment '{}' is compared up to {:.9g} s, and one of its runs "
                              "ends at {:.9g} s",
                              one.name, last, reached),
                  "give a window, or both runs the same simulation.end_time");
}

}  // namespace

std::string measured_offset_path(const std::string& experiment) {
  return fmt::format("{}{}.time_offset", kOffsetPrefix, experiment);
}

bool is_measured_offset(const std::string& path) {
  return path.starts_with(kOffsetPrefix);
}

std::unique_ptr<Evaluator> Evaluator::make(StudyInput input, std::vector<Parameter> parameters,
                                           const std::vector<Value>& first,
                                           Diagnostics& diagnostics) {
  Diagnostics found;
  const std::vector<Override> point = to_overrides(parameters, first);
  auto signals = check_study_signals(input, point, found);
  MeasuredReferences references(load_cases_of(input).size());
  if (signals && found.empty()) {
    MeasuredReferences made = make_measured_references(input, point, found);
    if (found.empty()) references = std::move(made);
  }
  if (signals) {
    check_response_names(input, *signals, parameters, found);
    check_times(input, references, found);
  }
  auto measured = make_file_sets(input, point, found);
  for (const LoadCaseInput& one : input.load_case) {
    if (one.measured && one.reference) check_reference_data(input, one, point, found);
  }
  std::unique_ptr<Evaluator> evaluator;
  if (signals && found.empty()) {
    evaluator.reset(
        new Evaluator(std::move(input), std::move(parameters), std::move(*signals), found));
  }
  diagnostics.append(found);
  if (!found.empty()) return nullptr;
  evaluator->measured_ = std::move(measured);
  evaluator->measured_references_ = std::move(references);
  return evaluator;
}

Evaluator::Evaluator(StudyInput input, std::vector<Parameter> parameters, StudySignals signals,
                     Diagnostics& diagnostics)
    : input_(std::move(input)),
      parameters_(std::move(parameters)),
      load_cases_(load_cases_of(input_)),
      signals_(std::move(signals)),
      layout_(layout_of(input_, signals_)),
      responses_(list_responses(input_, signals_)),
      judged_(list_judged_errors(input_, signals_, diagnostics)),
      objective_(list_objective_responses(input_, signals_, diagnostics)),
      references_(load_cases_.size()) {}

double Evaluator::worst(RunNumber number, const std::vector<double>& responses) const {
  double worst = kNan;
  for (std::size_t i = 0; i < load_cases_.size(); ++i) {
    const std::size_t index = i * layout_.width + layout_.index_of(number);
    if (index >= responses.size() || std::isnan(responses[index])) continue;
    const double value = responses[index];
    const bool is_worse = number == RunNumber::step_limit ? value < worst : value > worst;
    if (std::isnan(worst) || is_worse) worst = value;
  }
  return worst;
}

bool Evaluator::has_reference(std::size_t i) const {
  return reference_run_of(input_, load_cases_.at(i)) != nullptr;
}

const ReferenceRecord* Evaluator::reference(std::size_t load_case) {
  return has_reference(load_case) ? &run_reference(load_case) : nullptr;
}

std::shared_ptr<const MeasuredSet> Evaluator::measured_set(std::size_t load_case) {
  const LoadCaseInput& experiment = load_cases_.at(load_case);
  const ReferenceRecord* record = reference(load_case);
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const MeasuredSet>& set = measured_[load_case];
  if (set || !experiment.measured || record == nullptr) return set;
  std::vector<Channel> channels;
  for (const Series& series : record->match) {
    channels.insert(channels.end(), series.channels.begin(), series.channels.end());
  }
  Diagnostics found;
  set = std::make_shared<const MeasuredSet>(
      make_measured_set(*experiment.measured,
                        to_measured_data(*experiment.measured, record->traces), channels, found));
  if (!found.empty()) throw InvalidPoint(found.sorted().front().message);
  return set;
}

MeasuredRun Evaluator::measured_run(std::size_t load_case, const Point& point) {
  MeasuredRun run{measured_set(load_case)};
  run.reference = measured_references_.at(load_case);
  if (!run.set) return run;
  run.offset = run.set->offset;
  const std::string path = measured_offset_path(load_cases_[load_case].name);
  const auto found = std::ranges::find(parameters_, path, &Parameter::path);
  if (found == parameters_.end()) return run;
  run.varies = true;
  run.offset =
      std::get<double>(point.values.at(static_cast<std::size_t>(found - parameters_.begin())));
  return run;
}

const ReferenceRecord& Evaluator::run_reference(std::size_t load_case) {
  run_references({&load_case, 1});
  return *known_reference(load_case);
}

void Evaluator::run_references() {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < load_case_count(); ++i)
    if (has_reference(i)) all.push_back(i);
  run_references(all);
}

void Evaluator::run_references(std::span<const std::size_t> load_cases) {
  const std::lock_guard lock(mutex_);
  std::vector<std::size_t> missing;
  std::vector<const LoadCaseInput*> inputs;
  for (const std::size_t i : load_cases) {
    if (references_.at(i)) continue;
    missing.push_back(i);
    inputs.push_back(&load_cases_[i]);
  }
  std::vector<ReferenceRecord> records = linkstudy::run_references(input_, inputs, limits_of(0.0));
  for (std::size_t k = 0; k < missing.size(); ++k) references_[missing[k]] = std::move(records[k]);
}

const ReferenceRecord* Evaluator::known_reference(std::size_t load_case) const {
  const std::lock_guard lock(mutex_);
  const std::optional<ReferenceRecord>& record = references_.at(load_case);
  return record ? &*record : nullptr;
}

void Evaluator::set_reference(std::size_t load_case, ReferenceRecord record) {
  const std::optional<MeasuredInput>& measured = load_cases_.at(load_case).measured;
  const std::size_t signals = measured ? measured->signals.size() : input_.match.size();
  const bool fits = record.match.size() == signals &&
                    std::ranges::none_of(record.match, [](const Series& series) {
                      return series.channels.empty() || series.values.empty();
                    });
  if (!fits) throw std::out_of_range("a reference run of another study");
  const std::lock_guard lock(mutex_);
  references_.at(load_case) = std::move(record);
}

std::vector<CaseTraces> Evaluator::reference_traces() const {
  const std::lock_guard lock(mutex_);
  std::vector<CaseTraces> traces;
  for (std::size_t i = 0; i < load_cases_.size(); ++i) {
    if (references_[i]) traces.push_back({load_cases_[i].name, references_[i]->traces});
    if (measured_references_[i]) {
      traces.push_back({load_cases_[i].name, measured_references_[i]->traces});
    }
  }
  return traces;
}

ModelInput Evaluator::model_at(std::size_t load_case, const std::vector<Value>& point) const {
  return require_model(*input_.model, case_overrides(input_, load_cases_.at(load_case),
                                                     to_overrides(parameters_, point)));
}

std::optional<ModelInput> Evaluator::reference_model_at(std::size_t load_case) const {
  if (!has_reference(load_case)) return std::nullopt;
  const LoadCaseInput& one = load_cases_.at(load_case);
  return read_reference(reference_view(input_, one), one);
}

}  // namespace linkstudy
