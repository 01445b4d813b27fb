// What motions leave to the equations of motion.
#pragma once

#include <vector>

#include "core/model/mechanism.h"

namespace linkstudy {

inline bool is_driven(const Mechanism& m, VelocityIndex k) {
  return m.velocities[k].motion.exists();
}

// Numbers of the velocities that no motion prescribes, rising: columns of dense matrices.
inline std::vector<int> undriven_velocities(const Mechanism& m) {
  std::vector<int> undriven;
  for (const VelocityIndex k : indices_of(m.velocities))
    if (!is_driven(m, k)) undriven.push_back(k.value());
  return undriven;
}

}  // namespace linkstudy
