#include <fmt/format.h>

#include "study/cli/answer.h"
#include "study/cli/verb_table.h"
#include "study/report/results_tables.h"
#include "study/report/write_table.h"
#include "study/session/calibration_run.h"
#include "study/session/exit_code.h"

namespace linkstudy {
namespace {

std::string text_of(const calibration::FitReport& report, const StudyResults& results,
                    const std::string& digest) {
  std::string text = calibration::write_verdict(report) + "\n";
  for (const char* table : {"calibration", "data"}) {
    if (report.fit.status == calibration::FitStatus::failed) continue;
    text += text_of(make_results_table(results, table), output_width()) + "\n";
  }
  return text + fmt::format("results digest: {}\n", digest);
}

}  // namespace

VerbEnd answer_calibrate(StudySession& session, bool json) {
  const auto say = [&](const calibration::FitReport& report, const std::string& digest) {
    const bool has_failed = report.fit.status == calibration::FitStatus::failed;
    return VerbEnd{has_failed ? kNotTuned : kDone,
                   json ? calibration::write_json(report, digest) + "\n"
                        : text_of(report, session.record().results(), digest),
                   std::string(name_of(report.fit.status))};
  };
  return find_answer(session, json, run_calibration, say);
}

int run_calibrate(const CommandLine& line) {
  return run_answer(line, FileKind::calibrate);
}

}  // namespace linkstudy
