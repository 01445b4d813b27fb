#include <charconv>
#include <thread>

#include "core/base/isa.h"
#include "study/cli/asked_file.h"
#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/config/input_error.h"
#include "study/plan/write_forecast.h"
#include "study/report/console.h"
#include "study/report/write_table.h"
#include "study/schedule/launcher.h"
#include "study/session/exit_code.h"
#include "study/session/study_points.h"

namespace linkstudy {
namespace {

int count_processors() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

// Those that the job has, or else what this machine can run at once.
int default_ranks() {
  const std::string text = read_environment("SLURM_NTASKS").value_or("");
  int tasks = 0;
  std::from_chars(text.data(), text.data() + text.size(), tasks);
  if (tasks > 0) return tasks;
  return count_processors();
}

}  // namespace

int run_plan(const CommandLine& line) {
  require_writable("--csv", line.csv);
  const int lanes = simd_level().lanes;  // a wrong LINKSTUDY_SIMD or LINKSTUDY_LANES ends here
  Diagnostics diagnostics;
  const auto study = make_evaluator(read_study_input(line), diagnostics);
  throw_if_any(diagnostics);
  print_remarks(study->input().remarks);
  remove_old(line.csv);
  const plan::Forecast forecast = plan::make_forecast(
      *study, {line.ranks.value_or(default_ranks()), lanes, count_processors(), line.probe_s});
  if (line.csv) write_asked(*line.csv, csv_of(plan::evaluations_table(*study, forecast.work)));
  print_text(line, plan::write_text(study->input(), forecast));
  if (line.json) print_out(plan::write_json(study->input(), forecast) + "\n");
  return kDone;
}

}  // namespace linkstudy
