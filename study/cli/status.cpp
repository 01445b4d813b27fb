#include <fmt/format.h>

#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/report/status_report.h"
#include "study/session/exit_code.h"

namespace linkstudy {

int run_status(const CommandLine& line) {
  const StudyStatus status = read_status(line.inputs.front());
  if (!status.dropped.empty()) print_err(fmt::format("linkstudy: warning: {}\n", status.dropped));
  print_out(line.json ? status_json(status) : status_text(status));
  return kDone;
}

}  // namespace linkstudy
