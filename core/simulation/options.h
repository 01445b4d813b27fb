// How one simulation is run: the [simulation] table of a model.
#pragma once

#include "core/base/words.h"

namespace linkstudy {

// rk4: constant steps of the classical Runge-Kutta method. adaptive: explicit, Dormand and Prince.
// stiff: implicit, Radau IIA. The last two choose their steps by the tolerances, locate the begin
// and the end of contacts, and are seen by observers on the grid of `step`.
enum class Integrator { rk4, adaptive, stiff };
enum class Start { given, equilibrium };
// Where cut joints hold a motion twice, single reactions are not unique. cut: the multipliers of
// the cut joints are those of least norm, the tree joints bear the rest. loops: the reactions of
// all joints of the loops are least together (core/dynamics/shared_reactions.h). The motion is the
// same but for friction in joints, which feels them.
enum class RedundantReactions { cut, loops };

template <>
inline constexpr auto kWords<Integrator> = make_words<Integrator>(
    {{Integrator::rk4, "rk4", "classic Runge-Kutta with a constant step"},
     {Integrator::adaptive, "adaptive", "explicit Dormand-Prince"},
     {Integrator::stiff, "stiff",
      "implicit Runge-Kutta (Radau IIA); both find begin and end of contacts"}});
template <>
inline constexpr auto kWords<Start> =
    make_words<Start>({{Start::given, "given", "as the joints say"},
                       {Start::equilibrium, "equilibrium",
                        "statics first (joints with hold = true stay; friction is left out)"}});

template <>
inline constexpr auto kWords<RedundantReactions> = make_words<RedundantReactions>(
    {{RedundantReactions::cut, "cut",
      "multipliers of least norm in the cut joints, tree joints bear the rest"},
     {RedundantReactions::loops, "loops",
      "least over all joints of the loops; the motion is the same but for friction in joints, "
      "which feels them"}});

struct SimulationOptions {
  double end_time = 1.0;          // s
  double step = 1.0e-4;           // s; the run takes ceil(end_time / step) equal steps
  double output_interval = 1e-2;  // s; sampled channels and the energy ledger
  Integrator integrator = Integrator::rk4;
  double relative_tolerance = 1.0e-8;   // adaptive, stiff
  double absolute_tolerance = 1.0e-10;  // adaptive, stiff: in the units of each unknown
  long step_limit = 100'000'000;        // adaptive, stiff: more steps end the run (step_budget)
  Start start = Start::given;
  RedundantReactions redundant_reactions = RedundantReactions::cut;
  double statics_time = 0.0;    // s; loads count in equilibrium with their value then
  double drift_limit = 1.0e-3;  // m or rad; a larger gap of a cut closure ends the run

  bool operator==(const SimulationOptions&) const = default;
};

}  // namespace linkstudy
