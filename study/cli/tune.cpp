#include <fmt/format.h>

#include "study/cli/answer.h"
#include "study/cli/verb_table.h"
#include "study/session/exit_code.h"
#include "study/session/tuning_run.h"
#include "study/tune/write_tuning.h"

namespace linkstudy {

VerbEnd answer_tune(StudySession& session, bool json) {
  const auto say = [&](const std::vector<tuning::TuningResult>& results,
                       const std::string& digest) {
    const bool is_certified = worst_of(results) == tuning::TuningStatus::certified;
    return VerbEnd{is_certified ? kDone : kNotTuned,
                   json ? tuning::write_json(results, digest) + "\n"
                        : tuning::write_text(results) + fmt::format("results digest: {}\n", digest),
                   tuning::write_verdict(results)};
  };
  return find_answer(session, json, run_tuning, say);
}

int run_tune(const CommandLine& line) {
  return run_answer(line, FileKind::tune);
}

}  // namespace linkstudy
