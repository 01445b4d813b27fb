#include "study/tune/evaluation_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace linkstudy::tuning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void ensure_shape(const Answer& answer, std::size_t components) {
  if (answer.status == Cause::ok && answer.errors.size() != components) {
    throw std::logic_error(fmt::format("evaluation {} answered {} errors for {} match components",
                                       answer.id, answer.errors.size(), components));
  }
}

}  // namespace

double compute_ratio(const Answer& answer, const std::vector<MatchComponent>& components) {
  if (answer.status != Cause::ok || answer.errors.size() != components.size()) return kInfinity;
  double largest = 0.0;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const double error = answer.errors[i];
    if (!std::isfinite(error) || error < 0.0) return kInfinity;
    largest = std::max(largest, error / components[i].tolerance);
  }
  return largest;
}

std::size_t find_binding(const Answer& answer, const std::vector<MatchComponent>& components) {
  std::size_t binding = 0;
  const std::size_t count = std::min(answer.errors.size(), components.size());
  for (std::size_t i = 1; i < count; ++i) {
    const double best = answer.errors[binding] / components[binding].tolerance;
    if (answer.errors[i] / components[i].tolerance > best) binding = i;
  }
  return binding;
}

bool is_instability(Cause cause) {
  return cause == Cause::diverged || cause == Cause::energy_blowup || cause == Cause::step_budget ||
         cause == Cause::step_too_coarse;
}

Acceptance judge_acceptance(const Observation* base, const Observation* half,
                            const std::vector<MatchComponent>& components) {
  bool open = false;
  for (const Observation* observation : {base, half}) {
    if (observation == nullptr || is_transient(observation->answer.status)) {
      open = true;
    } else if (compute_ratio(observation->answer, components) > 1.0) {
      return Acceptance::rejected;
    }
  }
  return open ? Acceptance::open : Acceptance::accepted;
}

EvaluationLog::EvaluationLog(const TuningProblem& problem, const TuningOptions& options,
                             EvaluateBatch evaluate)
    : problem_(problem), options_(options), evaluate_(std::move(evaluate)) {}

double EvaluationLog::objective(const Observation& seen) const {
  return compute_objective(problem_, seen.request.x, seen.answer);
}

double EvaluationLog::objective(const std::vector<double>& x) const {
  const Observation* seen = find(x, 1.0);
  if (seen != nullptr) return objective(*seen);
  return problem_.response ? kInfinity : compute_objective(problem_, x, {});
}

double EvaluationLog::least_gain(double objective) const {
  return problem_.response ? options_.resolution * std::abs(objective) : options_.resolution;
}

std::size_t EvaluationLog::budget() const {
  return options_.max_evaluations.value_or(usual_budget(problem_.variables.size()));
}

bool EvaluationLog::evaluate(const std::vector<Request>& requests) {
  std::vector<Request> fresh;
  std::set<Key> asked;
  bool complete = true;
  for (const Request& request : requests) {
    const Key key{request.x, request.step_factor};
    if (known_.count(key) != 0 || asked.count(key) != 0) continue;
    if (fresh.size() == remaining()) {
      complete = false;
      break;
    }
    asked.insert(key);
    fresh.push_back(request);
  }
  for (std::size_t first = 0; first < fresh.size(); first += options_.batch) {
    const std::size_t last = std::min(first + options_.batch, fresh.size());
    ask({fresh.begin() + static_cast<std::ptrdiff_t>(first),
         fresh.begin() + static_cast<std::ptrdiff_t>(last)});
  }
  exhausted_ = exhausted_ || !complete;
  return complete;
}

void EvaluationLog::ask(const std::vector<Request>& requests) {
  const std::vector<Answer> answers = evaluate_(requests);
  if (answers.size() != requests.size()) {
    throw std::logic_error(
        fmt::format("{} requests got {} answers", requests.size(), answers.size()));
  }
  ++rounds_;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    ensure_shape(answers[i], problem_.components.size());
    known_[{requests[i].x, requests[i].step_factor}] = observations_.size();
    observations_.push_back({requests[i], answers[i]});
  }
}

const Observation* EvaluationLog::find(const std::vector<double>& x, double step_factor) const {
  const auto entry = known_.find({x, step_factor});
  return entry == known_.end() ? nullptr : &observations_[entry->second];
}

std::optional<double> EvaluationLog::ratio(double value, double step_factor) const {
  const Observation* observation = find({value}, step_factor);
  if (observation == nullptr) return std::nullopt;
  return compute_ratio(observation->answer, problem_.components);
}

Acceptance EvaluationLog::acceptance(const std::vector<double>& x) const {
  return judge_acceptance(find(x, 1.0), find(x, 0.5), problem_.components);
}

bool EvaluationLog::is_candidate(const std::vector<double>& x) const {
  const Observation* base = find(x, 1.0);
  return base != nullptr && compute_ratio(base->answer, problem_.components) <= 1.0 &&
         acceptance(x) != Acceptance::rejected;
}

std::vector<double> EvaluationLog::base_values() const {
  std::vector<double> values;
  for (const Observation& observation : observations_) {
    if (observation.request.step_factor == 1.0) values.push_back(observation.request.x.front());
  }
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace linkstudy::tuning
