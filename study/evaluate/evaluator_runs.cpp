// Points and load cases side by side: how evaluations are made of runs.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

#include "core/base/isa.h"
#include "study/evaluate/derived_damping.h"
#include "study/evaluate/evaluator.h"
#include "study/evaluate/sample_memory.h"
#include "study/metrics/invalid_point.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kAttempts = 3;  // an exception may be the machine's and not the point's

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

// A step of one run; what it throws ends that one and no other.
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

// In their order, each part with no more samples than there may be at once.
std::vector<CaseGroup> split_by_memory(const CaseGroup& group) {
  std::vector<CaseGroup> parts;
  double bytes = 0.0;
  for (PreparedCase* item : group) {
    const double own = sample_bytes(item->metrics.observers());
    bytes += own;
    if (parts.empty() || bytes > most_sample_bytes()) {
      parts.emplace_back();
      bytes = own;
    }
    parts.back().push_back(item);
  }
  return parts;
}

template <class Item>
void append(std::vector<Item>& all, std::vector<Item>& more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

// `parts`: what its load cases give, as far as they were begun; later ones of one that failed count
// for nothing.
struct Evaluator::Attempt {
  explicit Attempt(const Point& point) { result.point = point; }

  Evaluation result;
  std::vector<Evaluation> parts;
  double spent_s = 0.0;

  // Whether a load case is not in vain.
  bool goes_on(std::size_t load_case) const {
    return std::all_of(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(load_case),
                       [](const Evaluation& part) { return part.status == Cause::ok; });
  }
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
    one.result.responses.resize(responses_.size(), std::numeric_limits<double>::quiet_NaN());
    if (one.result.status != Cause::ok) one.result.residuals.clear();
    results.push_back(std::move(one.result));
  }
  return results;
}

// So many load cases together as fill the lanes: what is spent on a later load case of a point that
// fails in an earlier one is lost.
void Evaluator::attempt(std::span<Attempt> attempts) {
  const auto lanes = static_cast<std::size_t>(simd_level().lanes);
  const std::size_t together = std::max(std::size_t{1}, lanes / std::max(attempts.size(), 1ul));
  for (std::size_t i = 0; i < load_cases_.size(); i += together) {
    attempt(i, std::min(i + together, load_cases_.size()), attempts);
  }
  for (Attempt& one : attempts) join(one);
}

void Evaluator::attempt(std::size_t first, std::size_t last, std::span<Attempt> attempts) {
  std::vector<std::unique_ptr<PreparedCase>> cases;
  for (std::size_t i = first; i < last; ++i) prepare_cases(i, attempts, cases);
  for (CaseGroup& group : group_cases(cases)) {
    std::erase_if(group, [&](const PreparedCase* item) {
      return !attempts[item->point].goes_on(item->load_case);
    });
    for (const CaseGroup& part : split_by_memory(group)) run_group(part, attempts);
  }
}

void Evaluator::prepare_cases(std::size_t load_case, std::span<Attempt> attempts,
                              std::vector<std::unique_ptr<PreparedCase>>& cases) {
  const RunMetrics* like = nullptr;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    Attempt& one = attempts[i];
    if (one.parts.size() < load_case || !one.goes_on(load_case)) continue;
    Evaluation& part = one.parts.emplace_back();
    const Stopwatch watch(one.spent_s);
    std::unique_ptr<PreparedCase> prepared;
    guard(part, [&] { prepared = prepare_case(load_case, i, one, like); });
    if (!prepared || end_if_late(one)) continue;
    like = &prepared->metrics;
    cases.push_back(std::move(prepared));
  }
}

// The others of a group must not wait for one that has no time left.
bool Evaluator::end_if_late(Attempt& attempt) const {
  Evaluation& part = attempt.parts.back();
  if (cancelled_) {
    fail(part, Cause::cancelled, "cancelled");
    return true;
  }
  const bool is_late = timeout_s_ > 0.0 && attempt.spent_s >= timeout_s_;
  if (is_late) fail(part, Cause::timeout, "wall time used up before the run");
  return is_late;
}

// Nothing when it ended here.
std::unique_ptr<PreparedCase> Evaluator::prepare_case(std::size_t load_case, std::size_t point,
                                                      Attempt& attempt, const RunMetrics* like) {
  const ReferenceRecord* record = reference(load_case);
  Evaluation& part = attempt.parts.back();
  const ModelInput input = model_at(load_case, attempt.result.point.values);
  Preparation preparation = prepare(input.linkage, input.options);
  if (preparation.cause != Cause::ok) {
    fail(part, preparation.cause, preparation.message);
    return nullptr;
  }
  for (const std::string& warning : preparation.warnings) {
    part.warnings.push_back(named(load_cases_[load_case], warning));
  }
  const std::string& name = load_cases_[load_case].name;
  add_damping(input.linkage, preparation.model, name.empty() ? "" : name + "_", part.derived);
  const MeasuredRun measured = measured_run(load_case, attempt.result.point);
  const StudySignals signals =
      require_signals(input_, preparation.model.mechanism, measured.set.get());
  RunMetrics metrics(input_, signals, input.options, record, like, measured);
  const std::string refused = refuse_samples(sample_bytes(metrics.observers()));
  if (!refused.empty()) throw std::runtime_error(refused);
  const KnownLimit limit = find_known_limit(preparation, record);
  return std::unique_ptr<PreparedCase>(new PreparedCase{load_case, point, input.options,
                                                        std::move(preparation), std::move(metrics),
                                                        SimulationOutcome(), limit});
}

void Evaluator::run_group(const CaseGroup& group, std::span<Attempt> attempts) {
  double spent_s = 0.0;
  try {
    const Stopwatch watch(spent_s);
    run_cases(group, limits_of(time_left(group, attempts)));
  } catch (const std::exception& error) {
    for (const PreparedCase* item : group) {
      fail(attempts[item->point].parts[item->load_case], Cause::exception, error.what());
    }
    return;
  }
  // More cases than lanes take turns.
  const auto lanes = static_cast<double>(simd_level().lanes);
  spent_s *= std::min(1.0, lanes / static_cast<double>(group.size()));
  std::vector<bool> is_counted(attempts.size(), false);
  for (const PreparedCase* item : group) {
    Attempt& one = attempts[item->point];
    if (!is_counted[item->point]) one.spent_s += spent_s;
    is_counted[item->point] = true;
    const Stopwatch watch(one.spent_s);
    Evaluation& part = one.parts[item->load_case];
    guard(part, [&] { store(*item, part); });
  }
}

void Evaluator::store(const PreparedCase& item, Evaluation& part) const {
  // Nobody's result, and somebody waits.
  if (item.outcome.cause == Cause::cancelled) {
    fail(part, Cause::cancelled, item.outcome.message);
    return;
  }
  const SimulationOutcome outcome = item.metrics.judged(item.outcome);
  const std::string& name = load_cases_[item.load_case].name;
  part.responses = item.metrics.reduce(outcome);
  part.residuals = item.metrics.residuals(outcome);
  std::vector<Trace> traces = item.metrics.traces();
  if (!traces.empty()) part.traces.push_back({name, std::move(traces)});
  if (auto contacts = item.metrics.contacts(item.preparation.model.mechanism)) {
    part.contacts.push_back({name, std::move(*contacts)});
  }
  if (outcome.cause != Cause::ok) fail(part, outcome.cause, outcome.message);
}

// In the order of the load cases, up to the first that failed.
void Evaluator::join(Attempt& attempt) const {
  Evaluation& result = attempt.result;
  for (std::size_t i = 0; i < attempt.parts.size() && attempt.goes_on(i); ++i) {
    Evaluation& part = attempt.parts[i];
    append(result.warnings, part.warnings);
    append(result.derived, part.derived);
    append(result.responses, part.responses);
    append(result.residuals, part.residuals);
    append(result.traces, part.traces);
    append(result.contacts, part.contacts);
    if (part.status != Cause::ok) fail(result, part.status, named(load_cases_[i], part.message));
  }
  attempt.parts.clear();
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
