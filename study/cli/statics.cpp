#include <fmt/format.h>

#include <chrono>

#include "core/base/isa.h"
#include "core/dynamics/static_balance.h"
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
        channel.quantity == Quantity::q || channel.quantity == Quantity::joint_force ||
        channel.quantity == Quantity::joint_torque || channel.quantity == Quantity::closure_force ||
        channel.quantity == Quantity::closure_torque || channel.quantity == Quantity::closure_gap ||
        channel.quantity == Quantity::point_position;
    if (is_wanted) channels.push_back(channel);
  }
  return channels;
}

// "joint.P.hold", "joint.U.hold.1": the effort of a hold along a coordinate, on the child.
std::string hold_name(const Mechanism& m, int velocity) {
  const auto body = static_cast<std::size_t>(m.velocities[static_cast<std::size_t>(velocity)].body);
  const Body& b = m.bodies[body];
  const std::string name = "joint." + m.joint_names[body] + ".hold";
  return b.v_count == 1 ? name : fmt::format("{}.{}", name, velocity - b.v_begin);
}

// Values at the equilibrium: a run of one step, seen at its start, with what the holds bear as
// loads, so that the start is at rest.
std::vector<StaticValue> equilibrium_values(const Preparation& preparation,
                                            SimulationOptions options) {
  const StaticsReport& statics = *preparation.statics;
  const Model model = with_holding_efforts(preparation.model, statics);
  State<double> start = model.start;
  start.t = statics.time;
  options.end_time = options.step;
  Observers observers;
  observers.series.push_back({static_channels(model.mechanism), {0, 0, 1}, {}});
  simulate(model.mechanism, model.parameters, start, options, observers);
  const Series& series = observers.series.front();
  std::vector<StaticValue> values;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    values.push_back({series.channels[i].name, series.values[i], series.channels[i].unit});
  }
  for (const int k : model.held) {
    values.push_back(
        {hold_name(model.mechanism, k), statics.holding[k], effort_unit(model.mechanism, k)});
  }
  return values;
}

std::string values_text(const std::vector<StaticValue>& values) {
  std::string text = "\n";
  for (const StaticValue& value : values) {
    text += fmt::format("{:<28}{:>16.9g} {}\n", value.name, value.value, value.unit);
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
  std::vector<StaticValue> values;
  if (is_ok) values = equilibrium_values(preparation, input.options);
  if (is_ok) text += values_text(values);
  if (line.json) {
    fmt::print(stderr, "{}", text);
    print_out(statics_json(preparation, values, wall_s) + "\n");
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
