#include "study/tune/tune.h"

#include <fmt/format.h>

#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/session/end.h"
#include "study/session/exit_code.h"
#include "study/session/launch.h"
#include "study/session/tuning_run.h"
#include "study/tune/tuning_setup.h"
#include "study/tune/tuning_tables.h"
#include "study/tune/write_tuning.h"

namespace linkstudy {
namespace {

int print_result(bool json, const tuning::TuningResult& result, const std::string& digest) {
  if (json) {
    print_out(tuning::write_json(result, digest) + "\n");
  } else {
    print_out(tuning::write_text(result));
    print_out(fmt::format("results digest: {}\n", digest));
  }
  return result.status == tuning::TuningStatus::certified ? kDone : kNotTuned;
}

int run_tuning(bool json, StudySession& session) {
  const StudyInput& input = session.evaluator().input();
  std::optional<tuning::TuningResult> result;
  const StudyEnd end = end_study(session, [&] {
    TuningRun run(session);
    result = tuning::tune(make_tuning_problem(session.evaluator()), make_tuning_options(input),
                          [&](const auto& requests) { return run.evaluate(requests); });
    session.record().set_answer(AnswerKind::tuning, tuning::write_json(*result, ""),
                                tuning::make_tables(*result));
  });
  if (result) return print_result(json, *result, end.digest);
  // Interrupted, or with too many failures: no answer yet.
  if (json) print_out(to_json(end, session.record()));
  return end.code;
}

}  // namespace

int run_tune(const CommandLine& line) {
  return run_session(
      line, [&] { return read_study_input(line, FileKind::tune); },
      [&](StudySession& session) { return run_tuning(line.json, session); });
}

}  // namespace linkstudy
