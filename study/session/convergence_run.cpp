#include "study/session/convergence_run.h"

#include "study/converge/convergence_tables.h"
#include "study/converge/judge_convergence.h"
#include "study/converge/write_convergence.h"

namespace linkstudy {

convergence::Convergence run_convergence(StudySession& session) {
  const Evaluator& evaluator = session.evaluator();
  session.evaluate_design();
  const StudyRecord& record = session.record();
  const auto find_histories = [&](std::uint64_t id, const std::string& load_case) {
    return find_traces(record.results(), id, load_case);
  };
  convergence::Convergence result =
      convergence::judge_convergence(evaluator, record.evaluations(), find_histories);
  session.record().set_answer(AnswerKind::convergence, convergence::write_json(result, ""),
                              convergence::make_tables(result));
  return result;
}

}  // namespace linkstudy
