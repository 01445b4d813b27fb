// The tuner's view of a session: requests become evaluations with ids in the order asked. What the
// journal has is not run again, so a tune that is started again takes the same path to the same
// answers.
#pragma once

#include <vector>

#include "study/session/session.h"
#include "study/tune/tuning_problem.h"

namespace linkstudy {

class TuningRun {
 public:
  explicit TuningRun(StudySession& session);

  // Throws as StudySession::evaluate does.
  std::vector<tuning::Answer> evaluate(const std::vector<tuning::Request>& requests);

 private:
  tuning::Answer answer_of(std::uint64_t id) const;

  StudySession& session_;
  double base_step_;
  std::uint64_t next_id_ = 0;
};

}  // namespace linkstudy
