#include <fmt/format.h>

#include <chrono>

#include "core/base/isa.h"
#include "study/cli/asked_file.h"
#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/report/model_report.h"
#include "study/session/exit_code.h"

namespace linkstudy {

int run_statics(const CommandLine& line) {
  using Clock = std::chrono::steady_clock;
  simd_level();  // a wrong LINKSTUDY_SIMD or LINKSTUDY_LANES ends the program here
  ModelInput input = read_model_input(line);
  for (const std::string& closure : take_statics(input)) {
    print_err(fmt::format("linkstudy: note: closure '{}' has clearance: taken as an ideal joint\n",
                          closure));
  }
  const auto begin = Clock::now();
  const Preparation preparation = prepare(input.linkage, input.options);
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  print_err(warning_text(preparation));
  std::string text = preparation_text(line.inputs.front(), input.name, preparation, input.options);
  const bool is_ok = preparation.cause == Cause::ok;
  std::vector<StaticValue> values;
  if (is_ok) values = equilibrium_values(preparation, input.options);
  print_text(line, text + (is_ok ? values_text(values) : ""));
  if (line.json) print_out(statics_json(preparation, values, wall_s) + "\n");
  if (!is_ok) print_err(failure_text(preparation));
  return is_ok ? kDone : kTooManyFailed;
}

}  // namespace linkstudy
