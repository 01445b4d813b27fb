#include "study/session/sensitivity_run.h"

#include "study/sensitivity/judge_sensitivity.h"
#include "study/sensitivity/sensitivity_tables.h"
#include "study/sensitivity/write_sensitivity.h"

namespace linkstudy {

sensitivity::Sensitivity run_sensitivity(StudySession& session) {
  const Evaluator& evaluator = session.evaluator();
  session.evaluate_design();
  sensitivity::Sensitivity result = sensitivity::judge_sensitivity(
      evaluator.input(), evaluator.responses(), session.record().evaluations());
  session.record().set_answer(AnswerKind::sensitivity, sensitivity::write_json(result),
                              sensitivity::make_tables(result));
  return result;
}

}  // namespace linkstudy
