#include "study/evaluate/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "study/config/precedence.h"
#include "study/evaluate/derived_damping.h"
#include "study/metrics/invalid_point.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kOffsetPrefix = "experiment.";
constexpr std::uint32_t kAttempts = 3;  // an exception may be the machine's and not the point's

// A model that is there, or the first thing that is wrong with it.
ModelInput require_model(const ModelDocument& document, const std::vector<Override>& set) {
  Diagnostics diagnostics;
  std::optional<ModelInput> model = document.with(set, diagnostics);
  if (model) return std::move(*model);
  throw InvalidPoint(diagnostics.sorted().front().message);
}

StudySignals require_signals(const StudyInput& input, const Mechanism& mechanism,
                             const MeasuredSet* measured) {
  Diagnostics diagnostics;
  const std::vector<Channel> channels = list_channels(mechanism);
  StudySignals signals = find_case_signals(input, channels, diagnostics);
  if (!diagnostics.empty()) throw InvalidPoint(diagnostics.sorted().front().message);
  if (measured == nullptr) return signals;
  for (const MeasuredSignal& one : measured->signals) {
    const auto found = std::ranges::find(channels, one.channel, &Channel::name);
    if (found == channels.end()) {
      throw InvalidPoint(fmt::format("the model has no channel '{}'", one.channel));
    }
    signals.measured.push_back(*found);
  }
  return signals;
}

void fail(Evaluation& result, Cause cause, const std::string& message) {
  result.status = cause;
  result.message = message;
}

// A step of one evaluation; what it throws ends that one and no other.
template <class Step>
void guard(Evaluation& result, const Step& step) {
  try {
    step();
  } catch (const InvalidPoint& error) {
    fail(result, Cause::invalid_point, error.what());
  } catch (const ReferenceFailure& error) {
    const bool is_cancelled = error.cause() == Cause::cancelled;
    fail(result, is_cancelled ? Cause::cancelled : Cause::exception, error.what());
  } catch (const std::exception& error) {
    fail(result, Cause::exception, error.what());
  }
}

std::string named(const LoadCaseInput& load_case, const std::string& text) {
  if (load_case.name.empty()) return text;
  return fmt::format("{} '{}': {}", load_case.measured ? "experiment" : "load case", load_case.name,
                     text);
}

void name_load_case(const LoadCaseInput& load_case, Evaluation& result) {
  if (result.status != Cause::ok) result.message = named(load_case, result.message);
}

// Adds the time it lives.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  double& seconds_;
  Clock::time_point begin_ = Clock::now();
};

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
  const std::lock_guard lock(mutex_);
  std::optional<ReferenceRecord>& record = references_.at(load_case);
  if (!record) record = linkstudy::run_reference(input_, load_cases_[load_case], limits_of(0.0));
  return *record;
}

void Evaluator::run_references() {
  for (std::size_t i = 0; i < load_case_count(); ++i) reference(i);
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

struct Evaluator::Attempt {
  explicit Attempt(const Point& point) { result.point = point; }
  Evaluation result;
  double spent_s = 0.0;
  bool is_running() const { return result.status == Cause::ok; }
};

std::vector<Evaluation> Evaluator::evaluate(std::span<const Point> points) {
  std::vector<Attempt> attempts(points.begin(), points.end());
  attempt(attempts);
  for (Attempt& one : attempts) {
    for (std::uint32_t i = 2; i <= kAttempts && one.result.status == Cause::exception; ++i) {
      if (cancelled_) break;
      one = Attempt(one.result.point);
      attempt({&one, 1});
      one.result.attempts = i;
    }
  }
  std::vector<Evaluation> results;
  for (Attempt& one : attempts) {
    one.result.responses.resize(responses_.size(), kNan);
    if (one.result.status != Cause::ok) one.result.residuals.clear();
    results.push_back(std::move(one.result));
  }
  return results;
}

void Evaluator::attempt(std::span<Attempt> attempts) {
  for (std::size_t i = 0; i < load_cases_.size(); ++i) {
    std::vector<Attempt*> running;
    for (Attempt& one : attempts)
      if (one.is_running()) running.push_back(&one);
    const auto cases = prepare_cases(i, attempts);
    for (const CaseGroup& group : group_cases(cases)) run_group(i, group, attempts);
    for (Attempt* one : running) name_load_case(load_cases_[i], one->result);
  }
}

std::vector<std::unique_ptr<PreparedCase>> Evaluator::prepare_cases(std::size_t load_case,
                                                                    std::span<Attempt> attempts) {
  std::vector<std::unique_ptr<PreparedCase>> cases;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    Attempt& one = attempts[i];
    if (!one.is_running()) continue;
    const Stopwatch watch(one.spent_s);
    std::unique_ptr<PreparedCase> prepared;
    const RunMetrics* like = cases.empty() ? nullptr : &cases.back()->metrics;
    guard(one.result, [&] { prepared = prepare_case(load_case, i, one, like); });
    if (prepared) cases.push_back(std::move(prepared));
  }
  std::erase_if(cases, [&](const auto& item) { return end_if_late(attempts[item->point]); });
  return cases;
}

// The others of a group must not wait for one that has no time left.
bool Evaluator::end_if_late(Attempt& attempt) const {
  if (cancelled_) {
    fail(attempt.result, Cause::cancelled, "cancelled");
    return true;
  }
  const bool is_late = timeout_s_ > 0.0 && attempt.spent_s >= timeout_s_;
  if (is_late) fail(attempt.result, Cause::timeout, "wall time used up before the run");
  return is_late;
}

// Nothing when it ended here.
std::unique_ptr<PreparedCase> Evaluator::prepare_case(std::size_t load_case, std::size_t point,
                                                      Attempt& attempt, const RunMetrics* like) {
  const ReferenceRecord* record = reference(load_case);
  const ModelInput input = model_at(load_case, attempt.result.point.values);
  Preparation preparation = prepare(input.linkage, input.options);
  if (preparation.cause != Cause::ok) {
    fail(attempt.result, preparation.cause, preparation.message);
    return nullptr;
  }
  for (const std::string& warning : preparation.warnings) {
    attempt.result.warnings.push_back(named(load_cases_[load_case], warning));
  }
  const std::string& name = load_cases_[load_case].name;
  add_damping(input.linkage, preparation.model, name.empty() ? "" : name + "_",
              attempt.result.derived);
  const MeasuredRun measured = measured_run(load_case, attempt.result.point);
  const StudySignals signals =
      require_signals(input_, preparation.model.mechanism, measured.set.get());
  RunMetrics metrics(input_, signals, input.options, record, like, measured);
  const KnownLimit limit = find_known_limit(preparation, record);
  return std::unique_ptr<PreparedCase>(new PreparedCase{point, input.options,
                                                        std::move(preparation), std::move(metrics),
                                                        SimulationOutcome(), limit});
}

void Evaluator::run_group(std::size_t load_case, const CaseGroup& group,
                          std::span<Attempt> attempts) {
  double spent_s = 0.0;
  try {
    const Stopwatch watch(spent_s);
    run_cases(group, limits_of(time_left(group, attempts)));
  } catch (const std::exception& error) {
    for (const PreparedCase* item : group) {
      fail(attempts[item->point].result, Cause::exception, error.what());
    }
    return;
  }
  for (const PreparedCase* item : group) {
    Attempt& one = attempts[item->point];
    one.spent_s += spent_s;
    const Stopwatch watch(one.spent_s);
    guard(one.result, [&] { store(load_case, *item, one); });
  }
}

void Evaluator::store(std::size_t load_case, const PreparedCase& item, Attempt& attempt) {
  Evaluation& result = attempt.result;
  // Nobody's result, and somebody waits.
  if (item.outcome.cause == Cause::cancelled) {
    fail(result, Cause::cancelled, item.outcome.message);
    return;
  }
  const SimulationOutcome outcome = item.metrics.judged(item.outcome);
  const std::vector<double> numbers = item.metrics.reduce(outcome);
  result.responses.insert(result.responses.end(), numbers.begin(), numbers.end());
  const std::vector<double> residuals = item.metrics.residuals(outcome);
  result.residuals.insert(result.residuals.end(), residuals.begin(), residuals.end());
  std::vector<Trace> traces = item.metrics.traces();
  if (!traces.empty()) {
    result.traces.push_back({load_cases_[load_case].name, std::move(traces)});
  }
  if (auto contacts = item.metrics.contacts(item.preparation.model.mechanism)) {
    result.contacts.push_back({load_cases_[load_case].name, std::move(*contacts)});
  }
  if (outcome.cause != Cause::ok) fail(result, outcome.cause, outcome.message);
}

// What is left to the case with most of it: one that was long in preparing takes nothing from the
// others.
double Evaluator::time_left(const CaseGroup& group, std::span<Attempt> attempts) const {
  if (timeout_s_ <= 0.0) return 0.0;
  double left = 1e-6;
  for (const PreparedCase* item : group) {
    left = std::max(left, timeout_s_ - attempts[item->point].spent_s);
  }
  return left;
}

RunLimits Evaluator::limits_of(double timeout_s) {
  return {timeout_s, &cancelled_, &reached_};
}

}  // namespace linkstudy
