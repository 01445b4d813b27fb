#include <fmt/format.h>

#include <chrono>

#include "core/base/isa.h"
#include "study/cli/exit_code.h"
#include "study/cli/input.h"
#include "study/cli/model_report.h"
#include "study/cli/output.h"
#include "study/cli/verbs.h"
#include "study/metrics/run_metrics.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<Channel> static_channels(const Mechanism& mechanism) {
  std::vector<Channel> channels;
  for (const Channel& channel : list_channels(mechanism)) {
    const bool is_wanted =
        channel.quantity == Quantity::q || channel.quantity == Quantity::closure_force ||
        channel.quantity == Quantity::closure_torque || channel.quantity == Quantity::closure_gap ||
        channel.quantity == Quantity::point_position;
    if (is_wanted) channels.push_back(channel);
  }
  return channels;
}

// Values at the equilibrium: a run of one step, seen at its start.
std::string values_text(const Preparation& preparation, SimulationOptions options) {
  const Model& model = preparation.model;
  options.end_time = options.step;
  Observers observers;
  observers.series.push_back({static_channels(model.mechanism), {0, 0, 1}, {}});
  simulate(model.mechanism, model.parameters, model.start, options, observers);
  const Series& series = observers.series.front();
  std::string text = "\n";
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    text += fmt::format("{:<28}{:>16.9g} {}\n", series.channels[i].name, series.values[i],
                        series.channels[i].unit);
  }
  return text;
}

// At rest nothing tells where a loose journal lies in its bearing.
void take_ideal_bearings(Linkage& linkage) {
  for (Closure& closure : linkage.closures) {
    if (closure.model != ClosureModel::clearance) continue;
    closure.model = ClosureModel::cut;
    print_err(fmt::format("linkstudy: note: closure '{}' has clearance: taken as an ideal joint\n",
                          closure.name));
  }
}

}  // namespace

int run_statics(const CommandLine& line) {
  simd_level();  // a wrong LINKSTUDY_SIMD or LINKSTUDY_LANES ends the program here
  ModelInput input = read_model_input(line);
  input.options.start = Start::equilibrium;
  for (Joint& joint : input.linkage.joints) joint.velocity.clear();
  take_ideal_bearings(input.linkage);
  const auto begin = Clock::now();
  const Preparation preparation = prepare(input.linkage, input.options);
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  print_err(warning_text(preparation));
  std::string text = preparation_text(line.inputs.front(), input.name, preparation, input.options);
  const bool is_ok = preparation.cause == Cause::ok;
  if (is_ok) text += values_text(preparation, input.options);
  if (line.json) {
    fmt::print(stderr, "{}", text);
    print_out(outcome_json(preparation, nullptr, wall_s) + "\n");
  } else {
    print_out(text);
  }
  if (!is_ok) {
    print_err(
        fmt::format("linkstudy: error: {}: {}\n", name_of(preparation.cause), preparation.message));
  }
  return is_ok ? kDone : kTooManyFailed;
}

}  // namespace linkstudy
