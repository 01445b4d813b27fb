#include <fmt/format.h>

#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/converge/write_convergence.h"
#include "study/report/console.h"
#include "study/report/convergence_report.h"
#include "study/report/write_table.h"
#include "study/session/convergence_run.h"
#include "study/session/end.h"
#include "study/session/exit_code.h"
#include "study/session/launch.h"

namespace linkstudy {
namespace {

int run_refinement(bool json, StudySession& session) {
  std::optional<convergence::Convergence> result;
  const StudyEnd end = end_study(session, [&] { result = run_convergence(session); });
  if (!result) {
    // Interrupted, or with too many failures: no answer yet.
    if (json) print_out(to_json(end, session.record()));
    return end.code;
  }
  if (json) {
    print_out(convergence::write_json(*result, end.digest) + "\n");
  } else {
    print_out(convergence_text(*result, output_width()));
    print_out(fmt::format("results digest: {}\n", end.digest));
  }
  return result->is_settled() ? kDone : kNotConverged;
}

}  // namespace

int run_converge(const CommandLine& line) {
  return run_session(
      line, [&] { return read_study_input(line, FileKind::converge); },
      [&](StudySession& session) { return run_refinement(line.json, session); });
}

}  // namespace linkstudy
