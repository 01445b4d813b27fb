#include "study/session/tuning_run.h"

#include "study/session/study_points.h"

namespace linkstudy {

using tuning::Answer;
using tuning::Request;

TuningRun::TuningRun(StudySession& session)
    : session_(session), base_step_(base_step_of(session.evaluator().input())) {}

std::vector<Answer> TuningRun::evaluate(const std::vector<Request>& requests) {
  std::vector<Point> points;
  for (const Request& request : requests) {
    Point& point = points.emplace_back();
    point.id = next_id_++;
    point.values.assign(request.x.begin(), request.x.end());
    point.values.emplace_back(base_step_ * request.step_factor);
  }
  session_.evaluate(points);
  std::vector<Answer> answers;
  for (const Point& point : points) answers.push_back(answer_of(point.id));
  return answers;
}

Answer TuningRun::answer_of(std::uint64_t id) const {
  const Evaluator& evaluator = session_.evaluator();
  const Evaluation& evaluation = session_.record().evaluations().at(id);
  Answer answer;
  answer.id = id;
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

}  // namespace linkstudy
