// The instruction sets of this machine, each with the lanes of a full pack.
#pragma once

#include <vector>

#include "core/base/isa.h"

namespace linkstudy::testing {

inline std::vector<SimdLevel> simd_levels() {
  std::vector<SimdLevel> found;
  for (const char* set : {"baseline", "avx2", "avx512"}) {
    try {
      found.push_back(choose_simd_level(set, nullptr));
    } catch (const SimdError&) {  // not on this machine
    }
  }
  return found;
}

// The general step loop of every instruction set, and steps written at run time where there are
// such.
inline std::vector<SimdLevel> step_loops() {
  std::vector<SimdLevel> found;
  for (SimdLevel level : simd_levels()) {
    level.kernels = Kernels::general;
    found.push_back(level);
    if (level.isa == InstructionSet::baseline) continue;
    level.kernels = Kernels::written;
    found.push_back(level);
    level.lanes = 1;
    found.push_back(level);
  }
  return found;
}

}  // namespace linkstudy::testing
