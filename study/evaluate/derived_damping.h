// Damping in SI units where a model gives it as a ratio zeta: b = 2 zeta sqrt(c m_eff), N s/m of
// translations and N m s/rad of turns, as the prepared model has it (core/dynamics/effective_mass).
#pragma once

#include <string>
#include <vector>

#include "core/model/compile.h"
#include "study/record/evaluation.h"

namespace linkstudy {

// Appends, for every such closure, "closure.S.sde.damping_ratio" and "closure.S.sde.damping" (of
// turns "closure.S.sde.damping.turn"); one for each direction ("...damping.x") where they differ.
// `prefix` goes in front of the names.
void add_damping(const Linkage& linkage, const Model& model, const std::string& prefix,
                 std::vector<Trace>& derived);

}  // namespace linkstudy
