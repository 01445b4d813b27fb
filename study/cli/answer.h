// What the long verbs have to say when their work is done: `study`, `tune`, `calibrate`, `converge`
// print it, `queue` keeps the verdict.
#pragma once

#include <optional>

#include "study/cli/input.h"
#include "study/session/end.h"
#include "study/session/launch.h"

namespace linkstudy {

struct VerbEnd {
  int code = 0;         // exit code
  std::string text;     // for standard output: of people, or the object of --json
  std::string verdict;  // in a few words
};

// Rank 0; `json` asks for the object.
using AnswerWork = VerbEnd (*)(StudySession& session, bool json);

VerbEnd answer_study(StudySession& session, bool json);
VerbEnd answer_tune(StudySession& session, bool json);
VerbEnd answer_calibrate(StudySession& session, bool json);
VerbEnd answer_converge(StudySession& session, bool json);

// Throws std::logic_error for files that are no work.
AnswerWork answer_work(FileKind kind);

// Runs a file and prints; returns the exit code.
int run_answer(const CommandLine& line, const ReadInput& read, AnswerWork work);
// The same of a file that must be of that kind.
int run_answer(const CommandLine& line, FileKind kind);

// Evaluations that end in an answer: `work` takes the session and returns it, `say` takes it and
// the results digest.
template <class Work, class Say>
VerbEnd find_answer(StudySession& session, bool json, const Work& work, const Say& say) {
  std::optional<decltype(work(session))> answer;
  const StudyEnd end = end_study(session, [&] { answer = work(session); });
  if (answer) return say(*answer, end.digest);
  // Interrupted, or with too many failures: no answer yet.
  return {end.code, json ? to_json(end, session.record()) : "", end.status};
}

}  // namespace linkstudy
