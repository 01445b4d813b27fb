// The tuner's view of a session: requests become evaluations with ids in the order asked. What the
// journal has is not run again, so a tune that is started again takes the same path to the same
// answers.
#pragma once

#include <vector>

#include "study/session/evaluation_source.h"
#include "study/tune/tuning_result.h"

namespace linkstudy {

class TuningRun {
 public:
  TuningRun(const Evaluator& evaluator, EvaluationSource source);

  // Throws as the source does.
  std::vector<tuning::Answer> evaluate(const std::vector<tuning::Request>& requests);

 private:
  const Evaluator& evaluator_;
  EvaluationSource source_;
  double base_step_;
  std::uint64_t next_id_ = 0;
};

tuning::Answer to_answer(const Evaluator& evaluator, const Evaluation& evaluation);

// The search of all answers.
std::vector<tuning::TuningResult> search_tuning(const Evaluator& evaluator, TuningRun& run);
// The same; its answers are among the results. Throws as StudySession::evaluate does.
std::vector<tuning::TuningResult> run_tuning(StudySession& session);

}  // namespace linkstudy
