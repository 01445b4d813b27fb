#include <fmt/format.h>

#include "study/cli/exit_code.h"
#include "study/cli/input.h"
#include "study/cli/kinematics_file.h"
#include "study/cli/kinematics_report.h"
#include "study/cli/kinematics_table.h"
#include "study/cli/output.h"
#include "study/cli/verbs.h"
#include "study/store/file.h"
#include "study/store/group_file.h"

namespace linkstudy {

int run_kinematics(const CommandLine& line) {
  if (line.csv) require_writable(*line.csv);
  if (line.h5) require_writable(*line.h5);
  const ModelInput input = read_model_input(line);
  const Model closed = compile_closed(input.rigid);
  remove_old(line.csv);
  remove_old(line.h5);
  const KinematicsResult result = analyse_kinematics(line, input.kinematics, closed);
  const std::string text = kinematics_text(line.inputs.front(), input.name, result);
  if (line.csv) {
    const std::string csv = csv_of(kinematics_table(closed, result));
    line.csv == "-" ? print_out(csv) : write_file_atomically(*line.csv, csv);
  }
  if (line.h5) write_group_file(*line.h5, kinematics_group(input, closed, result, line.command));
  if (line.json || line.csv == "-") {
    fmt::print(stderr, "{}", text);
  } else {
    print_out(text);
  }
  if (line.json) print_out(kinematics_json(result) + "\n");
  const bool is_followed = (!result.driven || !result.cycle.poses.empty()) &&
                           !contradicts(result) && !ends_at_singular_angles(result);
  return result.assembly.closed && is_followed ? kDone : kTooManyFailed;
}

}  // namespace linkstudy
