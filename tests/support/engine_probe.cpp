#include "tests/support/engine_probe.h"

#include <cmath>
#include <stdexcept>

#include "core/dynamics/effective_mass.h"
#include "core/dynamics/motion.h"
#include "tests/support/random.h"

namespace linkstudy::testing {
namespace {

Model compile_damped(const Linkage& linkage, double t) {
  Model model = compile(linkage);
  resolve_damping(linkage, model.start, model);
  model.start.t = t;
  return model;
}

std::vector<Channel> channels_of(const std::vector<Channel>& all, const std::string& signal) {
  std::vector<Channel> found = find_channels(all, signal);
  if (found.empty()) throw std::invalid_argument("no channel " + signal);
  return found;
}

}  // namespace

EngineProbe::EngineProbe(const Linkage& linkage, double t)
    : model_(compile_damped(linkage, t)),
      channels_(list_channels(model_.mechanism)),
      w_(make_workspace<double>(model_.mechanism)),
      now_(std::make_unique<Instant<double>>(model_.mechanism, model_.parameters, w_)) {
  evaluate_at(model_.start);
}

void EngineProbe::evaluate_at(const State<double>& state) {
  model_.start = state;
  y_.assign(state.q.begin(), state.q.end());
  y_.insert(y_.end(), state.v.begin(), state.v.end());
  y_.insert(y_.end(), state.z.begin(), state.z.end());
  y_.insert(y_.end(), {state.supplied, state.dissipated, state.dissipated_in_contacts});
  compute_motion(model_.mechanism, model_.parameters, state, w_);
  now_->move_to(state.t, y_.data());
}

double EngineProbe::at(const std::string& channel) {
  return now_->sample(channels_of(channels_, channel).front());
}

Eigen::Vector3d EngineProbe::vector(const std::string& group) {
  const std::vector<Channel> found = channels_of(channels_, group);
  if (found.size() != 3) throw std::invalid_argument(group + " is no vector");
  return {now_->sample(found[0]), now_->sample(found[1]), now_->sample(found[2])};
}

Vector EngineProbe::qdd() const {
  return Eigen::Map<const Vector>(w_.qdd.data(), model_.mechanism.nv);
}

Vector EngineProbe::tau() const {
  return Eigen::Map<const Vector>(w_.tau.data(), model_.mechanism.nv);
}

Matrix EngineProbe::mass_matrix() const {
  return compute_mass_matrix(model_.mechanism, model_.parameters, model_.start);
}

std::vector<int> oracle_coordinates(const Mechanism& m, const TraceModel& trace) {
  std::vector<int> map;
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    const int first = coordinate_index(trace, m.joint_names[BodyIndex(b)]);
    for (int k = 0; k < m.bodies[BodyIndex(b)].v_count; ++k) map.push_back(first + k);
  }
  return map;
}

Vector reordered(const Vector& x, const std::vector<int>& map) {
  return x(map);
}

Matrix reordered(const Matrix& x, const std::vector<int>& map) {
  return x(map, map);
}

void shake(Linkage& linkage, std::uint64_t seed, double position, double velocity) {
  Random random(seed);
  for (Joint& joint : linkage.joints) {
    const int n = velocity_count(joint.type);
    joint.velocity.resize(static_cast<std::size_t>(n));
    for (double& v : joint.velocity) v += random.within(velocity);
    if (position_count(joint.type, joint.coordinates) != n) continue;
    joint.position.resize(static_cast<std::size_t>(n));
    for (double& q : joint.position) q += random.within(position);
  }
}

Samples run(const Model& model, const SimulationOptions& options,
            const std::vector<std::string>& signals) {
  const std::vector<Channel> all = list_channels(model.mechanism);
  const StepGrid grid = make_step_grid(options);
  Observers observers;
  Series series;
  for (const std::string& signal : signals) {
    for (const Channel& c : channels_of(all, signal)) series.channels.push_back(c);
  }
  series.sampling = {0, grid.count, std::max(1L, std::lround(options.output_interval / grid.h))};
  observers.series.push_back(series);
  Samples samples;
  samples.outcome = simulate(model.mechanism, model.parameters, model.start, options, observers);
  const Series& kept = observers.series.front();
  const auto rows = static_cast<Eigen::Index>(kept.rows());
  const auto columns = static_cast<Eigen::Index>(kept.channels.size());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  samples.values = Eigen::Map<const RowMajor>(kept.values.data(), rows, columns);
  return samples;
}

SimulationOutcome run(const Model& model, const SimulationOptions& options) {
  Observers none;
  return simulate(model.mechanism, model.parameters, model.start, options, none);
}

SimulationOptions steps_of(double step, double end_time, double interval) {
  SimulationOptions options;
  options.step = step;
  options.end_time = end_time;
  options.output_interval = interval > 0.0 ? interval : end_time;
  return options;
}

SimulationOptions adaptive_steps_of(double interval, double end_time, double tolerance) {
  SimulationOptions options = steps_of(interval, end_time, interval);
  options.integrator = Integrator::adaptive;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = 1e-2 * tolerance;
  return options;
}

double open_ledger(const SimulationOutcome& outcome) {
  return outcome.energy_residual_max / outcome.energy_scale;
}

}  // namespace linkstudy::testing
