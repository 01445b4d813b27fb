#include "study/cli/answer.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "study/report/console.h"

namespace linkstudy {
namespace {

constexpr std::array<std::pair<FileKind, AnswerWork>, 4> kWorks = {
    {{FileKind::study, answer_study},
     {FileKind::tune, answer_tune},
     {FileKind::calibrate, answer_calibrate},
     {FileKind::converge, answer_converge}}};

}  // namespace

AnswerWork answer_work(FileKind kind) {
  for (const auto& [of, work] : kWorks)
    if (of == kind) return work;
  throw std::logic_error("a file of this kind is not run in evaluations");
}

int run_answer(const CommandLine& line, const ReadInput& read, AnswerWork work) {
  return run_session(line, read, [&](StudySession& session) {
    const VerbEnd answer = work(session, line.json);
    print_out(answer.text);
    return answer.code;
  });
}

int run_answer(const CommandLine& line, FileKind kind) {
  return run_answer(
      line, [&] { return read_study_input(line, kind); }, answer_work(kind));
}

}  // namespace linkstudy
