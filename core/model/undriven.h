// What motions leave to the equations of motion.
#pragma once

#include <vector>

#include "core/model/mechanism.h"

namespace linkstudy {

inline bool is_driven(const Mechanism& m, int velocity) {
  return m.velocities[static_cast<std::size_t>(velocity)].motion >= 0;
}

// Velocity indices that no motion prescribes, rising.
inline std::vector<int> undriven_velocities(const Mechanism& m) {
  std::vector<int> undriven;
  for (int k = 0; k < m.nv; ++k)
    if (!is_driven(m, k)) undriven.push_back(k);
  return undriven;
}

}  // namespace linkstudy
