#include "core/simulation/kernels.h"

#if defined(__AVX2__)
#include "core/simulation/general_kernel.h"
#endif

namespace linkstudy {

std::span<const Kernel> avx2_kernels() {
#if defined(__AVX2__)
  static constexpr auto kernels = general_kernels<Avx2, 1, Avx2::lanes>(InstructionSet::avx2);
  return kernels;
#else
  return {};
#endif
}

}  // namespace linkstudy
