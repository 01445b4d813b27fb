#include "study/cli/asked_file.h"
#include "study/cli/kept.h"
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
  const ReadModel model = read_model(line);
  remove_old(line.csv);
  remove_old(line.h5);
  const KinematicsAnalysis found = analyse_course(model.input, line);
  const KinematicsResult& result = found.result;
  const Kept kept = keep_if_asked(line, model, course_text(line), results_of(found));
  if (line.csv) write_asked(*line.csv, csv_of(kinematics_table(*found.closed, result)));
  if (line.h5) {
    write_group_file(*line.h5, kinematics_group(model.input, *found.closed, result, line.command));
  }
  print_text(line,
             kinematics_text(line.inputs.front(), model.input.name, result) + digest_line(kept));
  if (line.json) print_out(with_digest(kinematics_json(result), kept) + "\n");
  return is_followed(result) ? kDone : kTooManyFailed;
}

}  // namespace linkstudy
