#include <fmt/format.h>

#include <optional>

#include "study/cli/answer.h"
#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/report/sensitivity_report.h"
#include "study/report/summary_table.h"
#include "study/report/write_table.h"
#include "study/sensitivity/write_sensitivity.h"
#include "study/session/end.h"
#include "study/session/exit_code.h"
#include "study/session/sensitivity_run.h"

namespace linkstudy {
namespace {

using Answer = std::optional<sensitivity::Sensitivity>;

std::string result_text(const StudyRecord& record, const Answer& answer) {
  return answer ? sensitivity_text(*answer, output_width())
                : text_of(summary_table(record.results()), output_width());
}

VerbEnd finish(bool json, StudySession& session, StudyEnd end, const Answer& answer) {
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
  VerbEnd out{end.code, "", end.status};
  if (json) {
    out.text = to_json(end, record, answer ? sensitivity::write_json(*answer) : "");
  } else if (end.code != kExitResumable) {
    out.text = result_text(record, answer) + fmt::format("results digest: {}\n", end.digest);
  }
  return out;
}

}  // namespace

VerbEnd answer_study(StudySession& session, bool json) {
  Answer answer;
  const StudyInput& input = session.evaluator().input();
  StudyEnd end = end_study(session, [&] {
    if (is_sensitivity(input.design.type)) {
      answer = run_sensitivity(session);
    } else {
      session.evaluate_design();
    }
  });
  return finish(json, session, std::move(end), answer);
}

int run_study(const CommandLine& line) {
  return run_answer(line, FileKind::study);
}

}  // namespace linkstudy
