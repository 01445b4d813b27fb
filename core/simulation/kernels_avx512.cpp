#include "core/simulation/kernels.h"

#if defined(__AVX512F__)
#include "core/simulation/general_kernel.h"
#endif

namespace linkstudy {

std::span<const Kernel> avx512_kernels() {
#if defined(__AVX512F__)
  static constexpr auto kernels = general_kernels<Avx512, Avx512::lanes>(InstructionSet::avx512);
  return kernels;
#else
  return {};
#endif
}

}  // namespace linkstudy
