// The order that a refinement should show, as the method has it:
//   simulation.step     4 of rk4, but 2 of what is reduced from samples: extremes between them,
//                       and means by the trapezoidal rule; none of integrators that choose their
//                       steps themselves
//   a stiffness         1: what is left of a stiff spring is its load over its stiffness
//   segments            2: rigid finite elements lump mass and bending
// NaN where none is known.
#pragma once

#include "core/simulation/options.h"
#include "study/config/study_input.h"

namespace linkstudy::convergence {

// `reduce`: of a response; nothing of a history or of its difference from another.
double find_formal_order(const std::string& path, Integrator integrator,
                         const std::optional<Reduction>& reduce);

}  // namespace linkstudy::convergence
