#include <fmt/format.h>

#include "study/cli/input.h"
#include "study/cli/run_points.h"
#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/report/summary_table.h"
#include "study/report/write_table.h"
#include "study/session/end.h"
#include "study/session/exit_code.h"
#include "study/session/study_points.h"

namespace linkstudy {
namespace {

int finish(bool json, StudySession& session, StudyEnd end) {
  StudyRecord& record = session.record();
  // A study of which nothing came out is no success, however many failures are accepted.
  if (end.code == kDone && !record.evaluations().empty() &&
      record.failure_count() == record.evaluations().size()) {
    end.code = kTooManyFailed;
    end.status = "failed";
    const auto& [id, first] = *record.evaluations().begin();
    print_err(fmt::format("linkstudy: error: every evaluation failed; evaluation {}: {}{}{}\n", id,
                          name_of(first.status), first.message.empty() ? "" : ": ", first.message));
  }
  if (json) {
    print_out(to_json(end, record));
    return end.code;
  }
  if (end.code != kExitResumable) {
    print_out(text_of(summary_table(record.results()), output_width()));
    print_out(fmt::format("results digest: {}\n", end.digest));
  }
  return end.code;
}

}  // namespace

int run_points(const CommandLine& line, const ReadInput& read) {
  return run_session(line, read, [&](StudySession& session) {
    const std::vector<Point> points = points_of(session.evaluator().input());
    return finish(line.json, session, end_study(session, [&] { session.evaluate(points); }));
  });
}

int run_study(const CommandLine& line) {
  return run_points(line, [&] { return read_study_input(line, FileKind::study); });
}

}  // namespace linkstudy
