#include <fmt/format.h>

#include "study/cli/answer.h"
#include "study/cli/verb_table.h"
#include "study/report/results_tables.h"
#include "study/report/write_table.h"
#include "study/session/calibration_run.h"
#include "study/session/exit_code.h"

namespace linkstudy {

int run_calibrate(const CommandLine& line) {
  const auto print = [&](const calibration::FitReport& report, const std::string& digest,
                         StudySession& session) {
    const bool has_failed = report.fit.status == calibration::FitStatus::failed;
    if (line.json) {
      print_out(calibration::write_json(report, digest) + "\n");
    } else {
      print_out(calibration::write_verdict(report) + "\n");
      for (const char* table : {"calibration", "data"}) {
        if (has_failed) continue;
        const Table made = make_results_table(session.record().results(), table);
        print_out(text_of(made, output_width()) + "\n");
      }
      print_out(fmt::format("results digest: {}\n", digest));
    }
    return has_failed ? kNotTuned : kDone;
  };
  return run_to_answer(line, FileKind::calibrate, run_calibration, print);
}

}  // namespace linkstudy
