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

}  // namespace linkstudy::testing
