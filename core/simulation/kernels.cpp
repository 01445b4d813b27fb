#include "core/simulation/kernels.h"

#include <stdexcept>
#include <vector>

namespace linkstudy {
namespace {

std::vector<Kernel>& added_kernels() {
  static std::vector<Kernel> kernels;
  return kernels;
}

}  // namespace

void add_kernels(std::span<const Kernel> kernels) {
  added_kernels().insert(added_kernels().end(), kernels.begin(), kernels.end());
}

const Kernel& find_kernel(const Mechanism& mechanism, InstructionSet isa, int lanes, bool general) {
  const auto fits = [&](const Kernel& k) { return k.isa == isa && k.lanes == lanes; };
  if (!general) {
    for (const Kernel& k : added_kernels()) {
      if (fits(k) && k.serves(mechanism)) return k;
    }
  }
  for (const auto kernels : {baseline_kernels(), avx2_kernels(), avx512_kernels()}) {
    for (const Kernel& k : kernels) {
      if (fits(k)) return k;
    }
  }
  throw std::logic_error("no step loop for this instruction set and number of lanes");
}

}  // namespace linkstudy
