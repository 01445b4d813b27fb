#include "study/session/tuning_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "study/session/study_points.h"
#include "study/tune/tune.h"
#include "study/tune/tuning_setup.h"
#include "study/tune/tuning_tables.h"
#include "study/tune/write_tuning.h"

namespace linkstudy {

using tuning::Answer;
using tuning::Request;

TuningRun::TuningRun(const Evaluator& evaluator, EvaluationSource source)
    : evaluator_(evaluator),
      source_(std::move(source)),
      base_step_(base_step_of(evaluator.input())) {}

std::vector<Answer> TuningRun::evaluate(const std::vector<Request>& requests) {
  std::vector<Point> points;
  for (const Request& request : requests) {
    Point& point = points.emplace_back();
    point.id = next_id_++;
    point.values.assign(request.x.begin(), request.x.end());
    point.values.emplace_back(base_step_ * request.step_factor);
  }
  source_.evaluate(points);
  std::vector<Answer> answers;
  for (const Point& point : points) {
    answers.push_back(to_answer(evaluator_, source_.find(point.id)));
  }
  return answers;
}

namespace {

// The largest of the responses, or of a largest wanted the smallest, to be minimised.
double find_objective(const Evaluator& evaluator, const std::vector<double>& responses) {
  const std::vector<std::size_t>& own = evaluator.objective_responses();
  if (own.empty()) return 0.0;
  const double sign = evaluator.input().objective->maximizes ? -1.0 : 1.0;
  double worst = -std::numeric_limits<double>::infinity();
  for (const std::size_t i : own) {
    const double value = sign * responses.at(i);
    if (std::isnan(value)) return value;
    worst = std::max(worst, value);
  }
  return worst;
}

}  // namespace

Answer to_answer(const Evaluator& evaluator, const Evaluation& evaluation) {
  Answer answer;
  answer.id = evaluation.point.id;
  answer.status = evaluation.status;
  answer.message = evaluation.message;
  answer.derived = evaluation.derived;
  answer.step = std::get<double>(evaluation.point.values.back());
  answer.h_omega = evaluator.worst(RunNumber::h_omega_max, evaluation.responses);
  answer.step_limit = evaluator.worst(RunNumber::step_limit, evaluation.responses);
  if (evaluation.status != Cause::ok) return answer;
  for (const JudgedError& error : evaluator.judged_errors()) {
    answer.errors.push_back(error_of(error, evaluation.responses.at(error.response)));
  }
  answer.objective = find_objective(evaluator, evaluation.responses);
  return answer;
}

std::vector<tuning::TuningResult> run_tuning(StudySession& session) {
  const Evaluator& evaluator = session.evaluator();
  TuningRun run(evaluator, source_of(session));
  std::vector<tuning::TuningResult> results = search_tuning(evaluator, run);
  session.record().set_answer(AnswerKind::tuning, tuning::write_json(results, ""),
                              tuning::make_tables(results));
  return results;
}

std::vector<tuning::TuningResult> search_tuning(const Evaluator& evaluator, TuningRun& run) {
  return tuning::tune(make_tuning_targets(evaluator), make_tuning_options(evaluator.input()),
                      [&](const auto& requests) { return run.evaluate(requests); });
}

}  // namespace linkstudy
