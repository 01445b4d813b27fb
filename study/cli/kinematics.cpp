#include "study/cli/asked_file.h"
#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/kinematics/file.h"
#include "study/kinematics/report.h"
#include "study/kinematics/table.h"
#include "study/report/console.h"
#include "study/report/write_table.h"
#include "study/session/exit_code.h"
#include "study/store/group_file.h"

namespace linkstudy {

int run_kinematics(const CommandLine& line) {
  require_writable("--csv", line.csv);
  require_writable("--h5", line.h5);
  const ModelInput input = read_model_input(line);
  const Model closed = compile_closed(input.rigid);
  remove_old(line.csv);
  remove_old(line.h5);
  const KinematicsResult result = analyse_kinematics(line, input.kinematics, closed);
  if (line.csv) write_asked(*line.csv, csv_of(kinematics_table(closed, result)));
  if (line.h5) write_group_file(*line.h5, kinematics_group(input, closed, result, line.command));
  print_text(line, kinematics_text(line.inputs.front(), input.name, result));
  if (line.json) print_out(kinematics_json(result) + "\n");
  return is_followed(result) ? kDone : kTooManyFailed;
}

}  // namespace linkstudy
