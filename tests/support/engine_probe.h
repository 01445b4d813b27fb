// The engine seen from outside: one evaluation of the equations of motion at one state, read
// through channels by name, and runs whose samples come back as a matrix.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/simulation/instant.h"
#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "tests/support/trace_model.h"

namespace linkstudy::testing {

// A linkage compiled, damping ratios resolved, evaluated at its start as given: not assembled.
class EngineProbe {
 public:
  explicit EngineProbe(const Linkage& linkage, double t = 0.0);

  double at(const std::string& channel);
  Eigen::Vector3d vector(const std::string& group);  // "closure.S.force" etc.
  Vector qdd() const;                                // (nv)
  Vector tau() const;  // (nv) applied forces less bias and gravity, without closures by cuts
  Matrix mass_matrix() const;  // (nv, nv)

  const Model& model() const { return model_; }
  const State<double>& state() const { return model_.start; }
  // Moves to another state of the same model.
  void evaluate_at(const State<double>& state);

 private:
  Model model_;
  std::vector<Channel> channels_;
  Workspace<double> w_;
  std::vector<double> y_;
  std::unique_ptr<Instant<double>> now_;
};

// Where the oracle keeps the engine's velocities: v_engine[k] = v_oracle[map[k]].
std::vector<int> oracle_coordinates(const Mechanism& m, const TraceModel& trace);
Vector reordered(const Vector& of_oracle, const std::vector<int>& map);
Matrix reordered(const Matrix& of_oracle, const std::vector<int>& map);

// Joint positions and velocities of a linkage's description changed by up to `size` each;
// quaternions are left alone.
void shake(Linkage& linkage, std::uint64_t seed, double position, double velocity);

// Samples of a run: one column a channel, one row an output instant (output_interval apart).
struct Samples {
  SimulationOutcome outcome;
  Matrix values;
};
Samples run(const Model& model, const SimulationOptions& options,
            const std::vector<std::string>& signals);
SimulationOutcome run(const Model& model, const SimulationOptions& options);

// Constant steps; output every `interval` seconds (0: at the end only).
SimulationOptions steps_of(double step, double end_time, double interval = 0.0);
// Adaptive steps to a relative tolerance, the absolute one a hundredth of it; output every
// `interval` seconds.
SimulationOptions adaptive_steps_of(double interval, double end_time, double tolerance);

// The greatest residual of the ledger in parts of the largest energy in it.
double open_ledger(const SimulationOutcome& outcome);

}  // namespace linkstudy::testing
