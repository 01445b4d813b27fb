#include "core/simulation/kernels.h"

#include <stdexcept>
#include <vector>

namespace linkstudy {
namespace {

std::vector<Kernel>& added_kernels() {
  static std::vector<Kernel> kernels;
  return kernels;
}

// Even the functions that list kernels are compiled for their instruction set: none is called on a
// machine without it.
std::span<const Kernel> general_kernels(InstructionSet isa) {
  if (!machine_has(isa)) return {};
  return isa == InstructionSet::avx512 ? avx512_kernels()
         : isa == InstructionSet::avx2 ? avx2_kernels()
                                       : baseline_kernels();
}

}  // namespace

void add_kernels(std::span<const Kernel> kernels) {
  added_kernels().insert(added_kernels().end(), kernels.begin(), kernels.end());
}

const Kernel& find_kernel(const Mechanism& mechanism, InstructionSet isa, int lanes, bool general) {
  const auto fits = [&](const Kernel& k) { return k.isa == isa && k.lanes == lanes; };
  if (!general) {
    for (const Kernel& k : added_kernels())
      if (fits(k) && k.serves(mechanism)) return k;
  }
  for (const Kernel& k : general_kernels(isa))
    if (fits(k)) return k;
  throw std::logic_error("no step loop for this instruction set and number of lanes");
}

}  // namespace linkstudy
