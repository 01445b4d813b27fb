#include "core/simulation/general_kernel.h"
#include "core/simulation/kernels.h"

namespace linkstudy {

std::span<const Kernel> baseline_kernels() {
  static constexpr auto kernels =
      general_kernels<Baseline, 1, Baseline::lanes>(InstructionSet::baseline);
  return kernels;
}

}  // namespace linkstudy
