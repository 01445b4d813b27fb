// The keys of [simulation].
#include <fmt/format.h>

#include "study/config/model_keys.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

void require_short_step(SimulationOptions& options, Tree& table, const Reading& reading) {
  if (!are_known(table, {"step", "end_time"}) || options.step <= options.end_time) return;
  reading.diagnostics.add(
      table.find("step")->at,
      fmt::format("simulation.step must not exceed end_time = {:.9g} s, got {:.9g} s",
                  options.end_time, options.step),
      "choose a smaller step or a later end");
}

}  // namespace

Fields<SimulationOptions> simulation_fields() {
  using Options = SimulationOptions;
  const Effect of_own_steps =
      acts_where("simulation.integrator", {Integrator::adaptive, Integrator::stiff});
  const Effect cut_joints =
      acts_where("closure.*.model", {ClosureModel::cut, ClosureModel::clearance});
  Fields<Options> tolerance;
  tolerance.add("relative", &Options::relative_tolerance,
                {.meaning = "part of the size of each unknown", .range = kPositive});
  tolerance.add("absolute", &Options::absolute_tolerance,
                {.meaning = "in the unit of each unknown", .range = kPositive});

  Fields<Options> run;
  run.add("end_time", &Options::end_time,
          {.meaning = "end of the run", .unit = "s", .range = kPositive});
  run.add("step", &Options::step,
          {.meaning = "time step; the run takes ceil(end_time / step) equal steps; adaptive and "
                      "stiff: the grid on which a run is seen",
           .unit = "s",
           .range = kPositive});
  run.add("integrator", &Options::integrator, {});
  run.table("tolerance",
            {.meaning = "error allowed in a step of adaptive and stiff",
             .standard = "{}",
             .effects = {of_own_steps}},
            std::move(tolerance));
  run.add("step_limit", &Options::step_limit,
          {.meaning = "adaptive, stiff: more steps end the run",
           .range = {.low = 1},
           .effects = {of_own_steps}});
  run.add("start", &Options::start, {});
  run.add("statics_time", &Options::statics_time,
          {.meaning = "start = \"equilibrium\" and the verb statics: loads count with their value "
                      "at this time; a run begins at t = 0 all the same",
           .unit = "s",
           .range = kNotNegative});
  run.add("redundant_reactions", &Options::redundant_reactions,
          {.meaning = "reactions where joints hold a motion twice and single ones are not unique",
           .effects = {cut_joints}});
  run.add("output_interval", &Options::output_interval,
          {.meaning = "time between samples of channels", .unit = "s", .range = kPositive});
  run.add("drift_limit", &Options::drift_limit,
          {.meaning = "a larger gap (m or rad) of a cut closure ends the run",
           .range = kPositive,
           .effects = {cut_joints}});
  run.finish(require_short_step);
  return run;
}

}  // namespace linkstudy
