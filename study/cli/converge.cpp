#include <fmt/format.h>

#include "study/cli/answer.h"
#include "study/cli/verb_table.h"
#include "study/converge/write_convergence.h"
#include "study/report/convergence_report.h"
#include "study/report/write_table.h"
#include "study/session/convergence_run.h"
#include "study/session/exit_code.h"

namespace linkstudy {

VerbEnd answer_converge(StudySession& session, bool json) {
  const auto say = [&](const convergence::Convergence& result, const std::string& digest) {
    return VerbEnd{result.is_settled() ? kDone : kNotConverged,
                   json ? convergence::write_json(result, digest) + "\n"
                        : convergence_text(result, output_width()) +
                              fmt::format("results digest: {}\n", digest),
                   result.is_settled() ? "orders found" : "no order found"};
  };
  return find_answer(session, json, run_convergence, say);
}

int run_converge(const CommandLine& line) {
  return run_answer(line, FileKind::converge);
}

}  // namespace linkstudy
