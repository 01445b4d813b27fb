#include "study/evaluate/evaluator.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "study/metrics/invalid_point.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kAttempts = 3;  // an exception may be the machine's and not the point's

// A model that is there, or the first thing that is wrong with it.
ModelInput require_model(const ModelDocument& document, const std::vector<Override>& set) {
  Diagnostics diagnostics;
  std::optional<ModelInput> model = document.with(set, diagnostics);
  if (model) return std::move(*model);
  throw InvalidPoint(diagnostics.sorted().front().message);
}

StudySignals require_signals(const StudyInput& input, const Mechanism& mechanism) {
  Diagnostics diagnostics;
  StudySignals signals = find_case_signals(input, list_channels(mechanism), diagnostics);
  if (!diagnostics.empty()) throw InvalidPoint(diagnostics.sorted().front().message);
  return signals;
}

void fail(CaseResult& result, Cause cause, const std::string& message) {
  result.status = cause;
  result.message = message;
}

struct SignalSource {
  std::vector<Channel> channels;
  double end_time = 0.0;
};

std::optional<SignalSource> read_source(const ModelDocument& document,
                                        const std::vector<Override>& set,
                                        Diagnostics& diagnostics) {
  const std::optional<ModelInput> model = document.with(set, diagnostics);
  if (!model) return std::nullopt;
  return SignalSource{list_channels(compile(model->linkage).mechanism), model->options.end_time};
}

std::vector<Override> join(std::vector<Override> set, const std::vector<Override>& more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

std::optional<StudySignals> check_study_signals(const StudyInput& input,
                                                const std::vector<Override>& first,
                                                Diagnostics& diagnostics) {
  const LoadCaseInput load_case = load_cases_of(input).front();
  const std::vector<Override> base = join(input.base_set, load_case.set);
  const auto own = read_source(*input.model, join(base, first), diagnostics);
  if (!own) return std::nullopt;
  StudySignals signals = find_case_signals(input, own->channels, diagnostics);
  if (!input.reference) {
    check_signals(input, signals, nullptr, own->end_time, diagnostics);
    return signals;
  }
  const auto other =
      read_source(*input.reference->model, join(input.reference->set, load_case.set), diagnostics);
  if (!other) return std::nullopt;
  const StudySignals reference = find_reference_signals(input, other->channels, diagnostics);
  check_signals(input, signals, &reference, std::min(own->end_time, other->end_time), diagnostics);
  return signals;
}

std::vector<Override> to_overrides(const std::vector<Parameter>& parameters,
                                   const std::vector<Value>& point) {
  std::vector<Override> set;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    set.push_back(make_override(parameters[i].path, point.at(i)));
  }
  return set;
}

}  // namespace

std::unique_ptr<Evaluator> Evaluator::make(StudyInput input, std::vector<Parameter> parameters,
                                           const std::vector<Value>& first,
                                           Diagnostics& diagnostics) {
  Diagnostics found;
  auto signals = check_study_signals(input, to_overrides(parameters, first), found);
  diagnostics.append(found);
  if (!signals || !found.empty()) return nullptr;
  return std::unique_ptr<Evaluator>(
      new Evaluator(std::move(input), std::move(parameters), std::move(*signals)));
}

Evaluator::Evaluator(StudyInput input, std::vector<Parameter> parameters, StudySignals signals)
    : input_(std::move(input)),
      parameters_(std::move(parameters)),
      load_cases_(load_cases_of(input_)),
      layout_(layout_of(signals)),
      responses_(list_responses(input_, signals)),
      judged_(list_judged_errors(input_, signals)),
      references_(load_cases_.size()) {}

std::vector<std::size_t> Evaluator::headline_responses() const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < responses_.size(); ++i) {
    const std::size_t within = i % layout_.width;
    const bool is_wanted = within < layout_.always ||
                           within == layout_.index_of(RunNumber::gap_max) ||
                           within == layout_.index_of(RunNumber::step_limit);
    if (is_wanted) indices.push_back(i);
  }
  return indices;
}

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

const ReferenceRecord* Evaluator::reference(std::size_t load_case,
                                            const std::atomic<bool>* cancelled) {
  if (!input_.reference) return nullptr;
  const std::lock_guard lock(mutex_);
  std::optional<ReferenceRecord>& record = references_[load_case];
  if (!record) record = run_reference(input_, load_cases_[load_case], cancelled);
  return &*record;
}

void Evaluator::run_references(const std::atomic<bool>* cancelled) {
  for (std::size_t i = 0; i < load_cases_.size(); ++i) reference(i, cancelled);
}

std::vector<CaseTraces> Evaluator::reference_traces() const {
  const std::lock_guard lock(mutex_);
  std::vector<CaseTraces> traces;
  for (std::size_t i = 0; i < load_cases_.size(); ++i) {
    if (references_[i]) traces.push_back({load_cases_[i].name, references_[i]->traces});
  }
  return traces;
}

std::vector<Override> Evaluator::overrides_of(const LoadCaseInput& load_case,
                                              const std::vector<Value>& point) const {
  return join(join(input_.base_set, load_case.set), to_overrides(parameters_, point));
}

CaseResult Evaluator::evaluate(const std::vector<Value>& point) {
  CaseResult result;
  for (std::uint32_t i = 1; i <= kAttempts; ++i) {
    result = attempt(point);
    result.attempts = i;
    if (result.status != Cause::exception) break;
  }
  result.responses.resize(responses_.size(), kNan);
  return result;
}

CaseResult Evaluator::attempt(const std::vector<Value>& point) {
  CaseResult result;
  const auto begin = Clock::now();
  for (std::size_t i = 0; i < load_cases_.size() && result.status == Cause::ok; ++i) {
    const std::chrono::duration<double> spent = Clock::now() - begin;
    const double left = timeout_s_ > 0.0 ? std::max(1e-6, timeout_s_ - spent.count()) : 0.0;
    try {
      run_case(i, point, left, result);
    } catch (const InvalidPoint& error) {
      fail(result, Cause::invalid_point, error.what());
    } catch (const std::exception& error) {
      fail(result, Cause::exception, error.what());
    }
    if (result.status != Cause::ok && !load_cases_[i].name.empty()) {
      result.message = fmt::format("load case '{}': {}", load_cases_[i].name, result.message);
    }
  }
  return result;
}

void Evaluator::run_case(std::size_t load_case, const std::vector<Value>& point, double timeout_s,
                         CaseResult& result) {
  const ReferenceRecord* record = reference(load_case, nullptr);
  const ModelInput input =
      require_model(*input_.model, overrides_of(load_cases_[load_case], point));
  const Preparation preparation = prepare(input.linkage, input.options);
  if (preparation.cause != Cause::ok) {
    return fail(result, preparation.cause, preparation.message);
  }
  const Model& model = preparation.model;
  RunMetrics metrics(input_, require_signals(input_, model.mechanism), input.options, record);
  const SimulationOutcome outcome =
      simulate(model.mechanism, model.parameters, model.start, input.options, metrics.observers(),
               RunLimits{timeout_s, nullptr});
  const std::vector<double> numbers =
      metrics.reduce(outcome, find_worst_spectrum(preparation, record));
  result.responses.insert(result.responses.end(), numbers.begin(), numbers.end());
  std::vector<Trace> traces = metrics.traces();
  if (!traces.empty()) {
    result.traces.push_back({load_cases_[load_case].name, std::move(traces)});
  }
  if (outcome.cause != Cause::ok) fail(result, outcome.cause, outcome.message);
}

}  // namespace linkstudy
