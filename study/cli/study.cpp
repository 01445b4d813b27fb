#include <fmt/format.h>

#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/report/results_table.h"
#include "study/session/end.h"
#include "study/session/exit_code.h"
#include "study/session/launch.h"
#include "study/session/study_points.h"

namespace linkstudy {
namespace {

// What a reader wants to see first; export has everything.
ResultsTableOptions choose_columns(const StudySession& session) {
  const Evaluator& evaluator = session.evaluator();
  ResultsTableOptions options;
  options.columns = {"evaluation"};
  for (const Parameter& p : evaluator.parameters()) options.columns.push_back(p.path);
  for (const std::size_t i : evaluator.headline_responses()) {
    options.columns.push_back(evaluator.responses()[i].name);
  }
  options.columns.emplace_back("status");
  return options;
}

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
  if (end.code != exit_resumable) {
    print_out(text_of(results_table(record.results(), choose_columns(session))));
    print_out(fmt::format("results digest: {}\n", end.digest));
  }
  return end.code;
}

}  // namespace

int run_study(const CommandLine& line) {
  return run_session(
      line, [&] { return read_study_input(line, StudyKind::study); },
      [&](StudySession& session) {
        const std::vector<Point> points = points_of(session.evaluator().input());
        return finish(line.json, session, end_study(session, [&] { session.evaluate(points); }));
      });
}

}  // namespace linkstudy
