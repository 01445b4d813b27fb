#include "study/session/tuning_run.h"

#include <utility>

#include "study/session/study_points.h"
#include "study/tune/tune.h"
#include "study/tune/tuning_setup.h"
#include "study/tune/tuning_tables.h"
#include "study/tune/write_tuning.h"

namespace linkstudy {

using tuning::Answer;
using tuning::Request;

TuningRun::TuningRun(StudySession& session)
    : TuningRun(session.evaluator(),
                {[&session](const std::vector<Point>& points) { session.evaluate(points); },
                 [&session](std::uint64_t id) -> const Evaluation& {
                   return session.record().evaluations().at(id);
                 }}) {}

TuningRun::TuningRun(const Evaluator& evaluator, Source source)
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
    answer.errors.push_back(evaluation.responses.at(error.response));
  }
  return answer;
}

tuning::TuningResult run_tuning(StudySession& session) {
  const Evaluator& evaluator = session.evaluator();
  TuningRun run(session);
  tuning::TuningResult result =
      tuning::tune(make_tuning_problem(evaluator), make_tuning_options(evaluator.input()),
                   [&](const auto& requests) { return run.evaluate(requests); });
  session.record().set_answer(AnswerKind::tuning, tuning::write_json(result, ""),
                              tuning::make_tables(result));
  return result;
}

}  // namespace linkstudy
