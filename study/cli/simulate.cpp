#include <fmt/format.h>

#include <chrono>

#include "core/base/isa.h"
#include "study/cli/answer.h"
#include "study/cli/asked_file.h"
#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/config/started_model.h"
#include "study/report/console.h"
#include "study/report/contacts_report.h"
#include "study/report/model_report.h"
#include "study/report/series_table.h"
#include "study/report/write_table.h"
#include "study/session/exit_code.h"
#include "study/session/single_run.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// As a study of one evaluation: stored, exported, verified and reported like any other.
int run_into_directory(const CommandLine& line) {
  require(!line.csv,
          "--csv with -o: the histories are in the directory; linkstudy export DIR "
          "--table traces --format csv prints them");
  require(!line.write_start, "--write-start goes without -o");
  return run_answer(
      line, [&] { return read_model_as_study(line); }, answer_study);
}

}  // namespace

int run_simulate(const CommandLine& line) {
  simd_level();  // a wrong LINKSTUDY_SIMD or LINKSTUDY_LANES ends the program here
  if (line.output) return run_into_directory(line);
  require(!line.fresh, "--fresh goes with -o DIR");
  require_writable("--csv", line.csv);
  require_writable("--write-start", line.write_start);
  require_other_file("--write-start", line.write_start, line.inputs.front());
  const ModelInput input = read_model_input(line);
  const auto begin = Clock::now();
  Observers observers;
  observers.contacts.most = 1;  // the hardest is kept beside them
  if (line.csv) observers.series.push_back(choose_series(input, line.signals));
  remove_old(line.csv);
  const Preparation preparation = prepare(input.linkage, input.options);
  print_err(warning_text(preparation));
  print_text(line, preparation_text(line.inputs.front(), input.name, preparation, input.options));
  if (preparation.cause != Cause::ok) {
    print_err(failure_text(preparation));
    if (line.json) print_out(outcome_json(preparation, nullptr, seconds_since(begin)) + "\n");
    return kTooManyFailed;
  }
  if (line.write_start) {
    write_asked(*line.write_start, started_model_text(input, preparation.model));
  }
  const SimulationOutcome outcome =
      run_watched(preparation, input.options, observers, line.timeout_s.value_or(0.0),
                  *find_word<ProgressMode>(line.progress));
  const double wall_s = seconds_since(begin);
  if (line.csv) write_asked(*line.csv, csv_of(series_table(observers.series.front())));
  if (!outcome.warning.empty()) {
    print_err(fmt::format("linkstudy: warning: {}\n", outcome.warning));
  }
  const std::string hardest = hardest_contact_text(preparation.model.mechanism, observers.contacts);
  print_text(line, outcome_text(outcome, input.options, hardest, wall_s));
  if (line.json) print_out(outcome_json(preparation, &outcome, wall_s) + "\n");
  return outcome.cause == Cause::ok ? kDone : kTooManyFailed;
}

}  // namespace linkstudy
