#include <fmt/format.h>

#include "study/cli/answer.h"
#include "study/cli/verb_table.h"
#include "study/converge/write_convergence.h"
#include "study/report/convergence_report.h"
#include "study/report/write_table.h"
#include "study/session/convergence_run.h"
#include "study/session/exit_code.h"

namespace linkstudy {

int run_converge(const CommandLine& line) {
  const auto print = [&](const convergence::Convergence& result, const std::string& digest,
                         StudySession&) {
    if (line.json) {
      print_out(convergence::write_json(result, digest) + "\n");
    } else {
      print_out(convergence_text(result, output_width()));
      print_out(fmt::format("results digest: {}\n", digest));
    }
    return result.is_settled() ? kDone : kNotConverged;
  };
  return run_to_answer(line, FileKind::converge, run_convergence, print);
}

}  // namespace linkstudy
