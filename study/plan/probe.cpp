#include "study/plan/probe.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/model/compile.h"
#include "study/config/input_error.h"
#include "study/config/precedence.h"

namespace linkstudy::plan {
namespace {

constexpr double kNothing = 1e-9;  // s: ends an evaluation when it is prepared
constexpr double kLeastShare = 1e-9;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

ModelInput reference_model(const StudyInput& input, const LoadCaseInput& load_case) {
  Diagnostics diagnostics;
  std::optional<ModelInput> model =
      reference_run_of(input, load_case)
          ->model->with(reference_overrides(reference_view(input, load_case), load_case),
                        diagnostics);
  throw_if_any(diagnostics);
  return std::move(*model);
}

std::unique_ptr<Evaluator> make_part(const Evaluator& study, std::size_t load_case,
                                     const std::vector<Value>& first) {
  StudyInput part = study.input();
  if (!part.load_case.empty()) part.load_case = {part.load_case.at(load_case)};
  Diagnostics diagnostics;
  auto evaluator = Evaluator::make(std::move(part), study.parameters(), first, diagnostics);
  throw_if_any(diagnostics);
  return evaluator;
}

}  // namespace

Probe::Probe(const Evaluator& study, std::size_t load_case, const std::vector<Value>& first)
    : evaluator_(make_part(study, load_case, first)) {}

RunPace Probe::measure_reference(double seconds) {
  const LoadCaseInput load_case = load_cases_of(evaluator_->input()).front();
  const double end_time = reference_model(evaluator_->input(), load_case).options.end_time;
  std::atomic<double> reached{0.0};
  RunLimits limits;
  limits.timeout_s = seconds;
  limits.reached = &reached;
  RunPace pace;
  const double begin = cpu_seconds();
  try {
    const LoadCaseInput* one = &load_case;
    evaluator_->set_reference(
        0, std::move(run_references(evaluator_->input(), {&one, 1}, limits).front()));
  } catch (const ReferenceFailure& failure) {
    if (failure.cause() != Cause::timeout) throw;
    pace.share = std::clamp(reached.load() / end_time, kLeastShare, 1.0);
    assume_reference();
  }
  pace.spent_s = cpu_seconds() - begin;
  pace.run_s = pace.spent_s / pace.share;
  return pace;
}

void Probe::assume_reference() {
  const LoadCaseInput load_case = load_cases_of(evaluator_->input()).front();
  const StudyInput view = reference_view(evaluator_->input(), load_case);
  const ModelInput model = reference_model(evaluator_->input(), load_case);
  const std::vector<Channel> channels = list_channels(compile(model.linkage).mechanism);
  Diagnostics diagnostics;
  const StudySignals signals = find_reference_signals(view, channels, diagnostics);
  throw_if_any(diagnostics);
  ReferenceRecord record;
  record.grid = make_step_grid(model.options);
  const auto rows = static_cast<std::size_t>(record.grid.count + 1);
  for (const std::vector<Channel>& match : signals.match) {
    record.match.push_back(
        {match, {0, record.grid.count, 1}, std::vector<double>(rows * match.size(), 0.0)});
  }
  evaluator_->set_reference(0, std::move(record));
}

double Probe::seconds_a_step(std::span<const Point> points, double seconds) {
  double steps = 0.0;
  const double begin = cpu_seconds();
  double spent = 0.0;
  evaluator_->set_timeout(seconds);
  while (spent < seconds) {
    for (const Evaluation& one : evaluator_->evaluate(points)) {
      const double own = evaluator_->worst(RunNumber::steps, one.responses);
      if (std::isfinite(own)) steps += own;
    }
    spent = cpu_seconds() - begin;
  }
  return spent / steps;
}

RunPace Probe::measure(std::span<const Point> points, double seconds) {
  RunPace pace;
  const double begin = cpu_seconds();
  evaluator_->set_timeout(kNothing);
  evaluator_->evaluate(points);
  const double prepared = cpu_seconds();
  const double setup_s = prepared - begin;
  pace.setup_s = setup_s / static_cast<double>(points.size());
  evaluator_->set_timeout(setup_s + seconds);
  const std::vector<Evaluation> results = evaluator_->evaluate(points);
  const double end = cpu_seconds();
  pace.spent_s = end - begin;
  bool has_ended = true;
  double reached = 0.0;
  for (const Evaluation& one : results) {
    has_ended = has_ended && one.status != Cause::timeout;
    const double steps = evaluator_->worst(RunNumber::steps, one.responses);
    const double time = evaluator_->worst(RunNumber::end_time, one.responses);
    if (std::isfinite(steps)) pace.steps += steps;
    if (std::isfinite(time)) reached = std::max(reached, time);
  }
  const double end_time = evaluator_->model_at(0, points.front().values).options.end_time;
  if (!has_ended) pace.share = std::clamp(reached / end_time, kLeastShare, 1.0);
  pace.run_s = std::max(0.0, end - prepared - setup_s) / pace.share;
  return pace;
}

}  // namespace linkstudy::plan
