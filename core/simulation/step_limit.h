// The largest stable step of the classical Runge-Kutta method along a run, and what is said of a
// run that went past it. Every stiff term is in it: springs, dampers, resistances, friction in
// joints and contacts, stiffness and damping of contacts; see core/dynamics/spectrum.h.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/dynamics/spectrum.h"
#include "core/simulation/kernel.h"

namespace linkstudy {

struct StepLimit {
  double seconds = std::numeric_limits<double>::infinity();  // not a number: not known
  double omega_max = 0.0;                                    // largest |eigenvalue|, rad/s
  double t = 0.0;                                            // where the limit was met, s
};

// The worse of both, each number by itself; what is not known counts where nothing else is.
StepLimit worse(const StepLimit& limit, const Spectrum& spectrum, double t);

// The worst of `known` and of the states kept of a run (core/simulation/looks.h); evenly: of those
// spread evenly too. Bristles count with the fastest they showed at any step.
StepLimit find_step_limit(const Mechanism& m, const Parameters<double>& p,
                          const std::vector<double>& looks, bool evenly, const LaneEnd& end,
                          const StepLimit& known);

// "simulation.step = 1e-4 s is past the stability limit 4.6e-6 s of RK4 at t = 0.2 s"
std::string describe_past_limit(double h, const StepLimit& limit);

}  // namespace linkstudy
