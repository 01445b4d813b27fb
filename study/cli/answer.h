// Verbs whose evaluations end in an answer: a tuning, a fit, orders of convergence.
#pragma once

#include <optional>

#include "study/cli/input.h"
#include "study/report/console.h"
#include "study/session/end.h"
#include "study/session/launch.h"

namespace linkstudy {

// `work` takes the session and returns the answer, `print` takes answer, results digest and session
// and returns the exit code.
template <class Work, class Print>
int run_to_answer(const CommandLine& line, FileKind kind, const Work& work, const Print& print) {
  const auto in_session = [&](StudySession& session) {
    std::optional<decltype(work(session))> answer;
    const StudyEnd end = end_study(session, [&] { answer = work(session); });
    if (answer) return print(*answer, end.digest, session);
    // Interrupted, or with too many failures: no answer yet.
    if (line.json) print_out(to_json(end, session.record()));
    return end.code;
  };
  return run_session(
      line, [&] { return read_study_input(line, kind); }, in_session);
}

}  // namespace linkstudy
