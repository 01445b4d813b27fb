#include <fmt/format.h>

#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/report/results_tables.h"
#include "study/report/write_table.h"
#include "study/session/calibration_run.h"
#include "study/session/end.h"
#include "study/session/exit_code.h"
#include "study/session/launch.h"

namespace linkstudy {
namespace {

int print_fit(bool json, const calibration::FitReport& report, const std::string& digest,
              const StudyResults& results) {
  const bool has_failed = report.fit.status == calibration::FitStatus::failed;
  if (json) {
    print_out(calibration::write_json(report, digest) + "\n");
  } else {
    print_out(calibration::write_verdict(report) + "\n");
    for (const char* table : {"calibration", "data"}) {
      if (has_failed) continue;
      print_out(text_of(make_results_table(results, table), output_width()) + "\n");
    }
    print_out(fmt::format("results digest: {}\n", digest));
  }
  return has_failed ? kNotTuned : kDone;
}

int calibrate_in(bool json, StudySession& session) {
  std::optional<calibration::FitReport> report;
  const StudyEnd end = end_study(session, [&] {
    report = run_calibration(session);
    session.record().set_answer(AnswerKind::calibration, calibration::write_json(*report, ""),
                                calibration::make_tables(*report));
  });
  if (report) return print_fit(json, *report, end.digest, session.record().results());
  // Interrupted, or with too many failures: no answer yet.
  if (json) print_out(to_json(end, session.record()));
  return end.code;
}

}  // namespace

int run_calibrate(const CommandLine& line) {
  return run_session(
      line, [&] { return read_study_input(line, FileKind::calibrate); },
      [&](StudySession& session) { return calibrate_in(line.json, session); });
}

}  // namespace linkstudy
