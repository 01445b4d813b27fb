// How one simulation is run: the [simulation] table of a model.
#pragma once

namespace linkstudy {

enum class Integrator { rk4 };
enum class Start { given, equilibrium };

struct SimulationOptions {
  double end_time = 1.0;          // s
  double step = 1.0e-4;           // s; the run takes ceil(end_time / step) equal steps
  double output_interval = 1e-2;  // s; sampled channels and the energy ledger
  Integrator integrator = Integrator::rk4;
  Start start = Start::given;
  double drift_limit = 1.0e-3;  // m or rad; a larger gap of a cut closure ends the run
};

}  // namespace linkstudy
