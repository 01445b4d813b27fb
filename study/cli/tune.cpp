#include <fmt/format.h>

#include "study/cli/answer.h"
#include "study/cli/verb_table.h"
#include "study/session/exit_code.h"
#include "study/session/tuning_run.h"
#include "study/tune/write_tuning.h"

namespace linkstudy {

int run_tune(const CommandLine& line) {
  const auto print = [&](const std::vector<tuning::TuningResult>& results,
                         const std::string& digest, StudySession&) {
    if (line.json) {
      print_out(tuning::write_json(results, digest) + "\n");
    } else {
      print_out(tuning::write_text(results));
      print_out(fmt::format("results digest: {}\n", digest));
    }
    return worst_of(results) == tuning::TuningStatus::certified ? kDone : kNotTuned;
  };
  return run_to_answer(line, FileKind::tune, run_tuning, print);
}

}  // namespace linkstudy
