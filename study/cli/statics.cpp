#include <fmt/format.h>

#include "core/base/isa.h"
#include "study/cli/asked_file.h"
#include "study/cli/kept.h"
#include "study/cli/verb_table.h"
#include "study/config/started_model.h"
#include "study/report/console.h"
#include "study/report/model_report.h"
#include "study/report/modes_report.h"
#include "study/session/exit_code.h"

namespace linkstudy {

int run_statics(const CommandLine& line) {
  simd_level();  // a wrong LINKSTUDY_SIMD or LINKSTUDY_LANES ends the program here
  require_writable("--write-start", line.write_start);
  require_other_file("--write-start", line.write_start, line.inputs.front());
  const ReadModel model = read_model(line);
  const StaticsAnalysis found = analyse_statics(model.input);
  for (const std::string& closure : found.made_ideal) {
    print_err(fmt::format("linkstudy: note: closure '{}' has clearance: taken as an ideal joint\n",
                          closure));
  }
  const Preparation& preparation = found.preparation;
  const Kept kept = keep_if_asked(line, model, "", results_of(found));
  print_err(warning_text(preparation));
  const bool is_ok = preparation.cause == Cause::ok;
  if (is_ok && line.write_start) {
    write_asked(*line.write_start, started_model_text(model.input, preparation.model));
  }
  print_text(
      line,
      preparation_text(line.inputs.front(), model.input.name, preparation, found.input.options) +
          (is_ok ? values_text(found.values) : "") +
          (is_ok && line.modes ? modes_text(preparation.model.mechanism, found.modes, *line.modes)
                               : "") +
          digest_line(kept));
  if (line.json) {
    print_out(
        with_digest(statics_json(preparation, found.values, found.modes, found.wall_s), kept) +
        "\n");
  }
  if (!is_ok) print_err(failure_text(preparation));
  return is_ok ? kDone : kTooManyFailed;
}

}  // namespace linkstudy
