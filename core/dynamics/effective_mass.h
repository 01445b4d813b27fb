// Effective mass of the sdes of a closure at a state, m_eff = 1 / max eig(J M^-1 J^T), separately
// for its translational rows (kg) and rotational rows (kg m^2), and the damping that a ratio asks
// for: b = 2 zeta sqrt(c m_eff).
#pragma once

#include "core/model/compile.h"

namespace linkstudy {

struct EffectiveMass {
  double translation = 0.0;  // kg, 0 without such rows
  double rotation = 0.0;     // kg m^2
};

EffectiveMass compute_effective_mass(const Model& model, const State<double>& s,
                                     ClosureIndex closure);

// Writes the damping of every sde given by damping_ratio into model.parameters.
void resolve_damping(const Linkage& linkage, const State<double>& s, Model& model);

}  // namespace linkstudy
