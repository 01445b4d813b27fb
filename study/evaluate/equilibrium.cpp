#include "study/evaluate/equilibrium.h"

#include <fmt/format.h>

#include "core/dynamics/static_balance.h"
#include "core/model/undriven.h"
#include "core/simulation/simulate.h"
#include "core/topology/resting_motions.h"

namespace linkstudy {
namespace {

std::vector<Channel> static_channels(const Mechanism& mechanism) {
  std::vector<Channel> channels;
  for (const Channel& channel : list_channels(mechanism)) {
    const bool is_wanted =
        channel.quantity == Quantity::q || channel.quantity == Quantity::joint_force ||
        channel.quantity == Quantity::joint_torque || channel.quantity == Quantity::closure_force ||
        channel.quantity == Quantity::closure_torque || channel.quantity == Quantity::closure_gap ||
        channel.quantity == Quantity::motion_effort ||
        channel.quantity == Quantity::coupling_effort ||
        channel.quantity == Quantity::spring_length || channel.quantity == Quantity::spring_force ||
        channel.quantity == Quantity::point_position;
    if (is_wanted) channels.push_back(channel);
  }
  return channels;
}

// "joint.P.hold", "joint.U.hold.1": the effort of a hold along a coordinate, on the child.
std::string hold_name(const Mechanism& m, VelocityIndex velocity) {
  const BodyIndex body = m.velocities[velocity].body;
  const Body& b = m.bodies[body];
  const std::string name = "joint." + m.joint_names[body] + ".hold";
  return b.v_count == 1 ? name : fmt::format("{}.{}", name, velocity - b.v_begin);
}

}  // namespace

std::vector<std::string> take_statics(ModelInput& input) {
  input.options.start = Start::equilibrium;
  for (Joint& joint : input.linkage.joints) joint.velocity.clear();
  input.linkage = with_resting_motions(std::move(input.linkage));
  std::vector<std::string> made_ideal;
  for (Closure& closure : input.linkage.closures) {
    if (closure.model != ClosureModel::clearance) continue;
    closure.model = ClosureModel::cut;
    made_ideal.push_back(closure.name);
  }
  return made_ideal;
}

// A run of one step, seen at its start, with what the holds bear as
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
  for (const VelocityIndex k : model.held) {
    if (is_driven(model.mechanism, k)) continue;
    values.push_back({hold_name(model.mechanism, k), statics.holding[k.value()],
                      effort_unit(model.mechanism, k)});
  }
  return values;
}

}  // namespace linkstudy
