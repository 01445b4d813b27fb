// What the long verbs share: the same steps on every rank, with a gate after each, so that all
// ranks leave together with one exit code and only rank 0 speaks.
//   read the input -> open the results directory (rank 0) -> run the references -> hand out work
#pragma once

#include <functional>

#include "study/session/session.h"

namespace linkstudy {

// Every rank reads; throws what describe_failure (session/failure.h) knows.
using ReadInput = std::function<StudyInput()>;
// Runs on rank 0 and returns the exit code.
using SessionWork = std::function<int(StudySession& session)>;

int run_session(const SessionOptions& options, const ReadInput& read, const SessionWork& work);

}  // namespace linkstudy
