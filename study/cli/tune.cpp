#include "study/tune/tune.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "study/cli/exit_code.h"
#include "study/cli/output.h"
#include "study/cli/study_end.h"
#include "study/cli/tuning_group.h"
#include "study/cli/tuning_setup.h"
#include "study/cli/verbs.h"
#include "study/tune/write_tuning.h"

namespace linkstudy {
namespace {

using tuning::Answer;
using tuning::Request;

// Requests become evaluations with ids in the order asked; what the journal has is not run again,
// so a tune that is started again takes the same path to the same answers.
class TuningRun {
 public:
  explicit TuningRun(StudySession& session)
      : session_(session), base_step_(base_step_of(session.evaluator().input())) {}

  std::vector<Answer> evaluate(const std::vector<Request>& requests) {
    std::vector<Point> points;
    for (const Request& request : requests) {
      points.push_back({next_id_++, {request.x.front(), base_step_ * request.step_factor}});
    }
    session_.evaluate(points);
    std::vector<Answer> answers;
    for (const Point& point : points) answers.push_back(answer_of(point.id));
    return answers;
  }

 private:
  Answer answer_of(std::uint64_t id) const {
    const Evaluator& evaluator = session_.evaluator();
    const Evaluation& evaluation = session_.record().evaluations().at(id);
    Answer answer;
    answer.id = id;
    answer.status = evaluation.status;
    answer.message = evaluation.message;
    answer.step = std::get<double>(evaluation.point.values.back());
    answer.h_omega = evaluator.worst(RunNumber::h_omega_max, evaluation.responses);
    answer.step_limit = evaluator.worst(RunNumber::step_limit, evaluation.responses);
    if (evaluation.status != Cause::ok) return answer;
    for (const JudgedError& error : evaluator.judged_errors()) {
      answer.errors.push_back(evaluation.responses.at(error.response));
    }
    return answer;
  }

  StudySession& session_;
  double base_step_;
  std::uint64_t next_id_ = 0;
};

int print_result(const StudySession& session, const tuning::TuningResult& result,
                 const std::string& digest) {
  if (session.line().json) {
    print_out(tuning::write_json(result, digest) + "\n");
  } else {
    print_out(tuning::write_text(result));
    print_out(fmt::format("results digest: {}\n", digest));
  }
  return result.status == tuning::TuningStatus::certified ? kDone : kNotTuned;
}

// Interrupted, or with too many failures: no answer yet.
int print_unfinished(StudySession& session, const StudyEnd& end) {
  if (!session.line().json) return end.code;
  const nlohmann::ordered_json json = {{"status", end.status},
                                       {"evaluations", session.record().evaluations().size()},
                                       {"digest", end.digest}};
  print_out(json.dump() + "\n");
  return end.code;
}

int run(StudySession& session) {
  const StudyInput& input = session.evaluator().input();
  const tuning::TuningProblem problem = make_tuning_problem(session.evaluator());
  const tuning::TuningOptions options = make_tuning_options(input);
  std::optional<tuning::TuningResult> result;
  const StudyEnd end = end_study(session, [&] {
    TuningRun tuning_run(session);
    result = tuning::tune(problem, options, [&](const std::vector<Request>& requests) {
      return tuning_run.evaluate(requests);
    });
    session.record().set_tuning(slug_of(input.name), tuning::write_json(*result, ""),
                                make_tuning_group(*result));
  });
  return result ? print_result(session, *result, end.digest) : print_unfinished(session, end);
}

}  // namespace

int run_tune(const CommandLine& line) {
  return run_session(line, StudyKind::tune, run);
}

}  // namespace linkstudy
