#include "core/simulation/kernels.h"

#include <stdexcept>

namespace linkstudy {
namespace {

// Even the functions that list kernels are compiled for their instruction set: none is called on a
// machine without it.
std::span<const Kernel> kernels_of(InstructionSet isa) {
  if (!machine_has(isa)) return {};
  return isa == InstructionSet::avx512 ? avx512_kernels()
         : isa == InstructionSet::avx2 ? avx2_kernels()
                                       : baseline_kernels();
}

}  // namespace

TrialPack::~TrialPack() = default;

const Kernel& find_kernel(InstructionSet isa, int lanes) {
  // One lane is the same code, and has the same bits.
  if (isa == InstructionSet::avx512 && lanes == 1) isa = InstructionSet::avx2;
  for (const Kernel& k : kernels_of(isa))
    if (k.isa == isa && k.lanes == lanes) return k;
  throw std::logic_error("no step loop for this instruction set and number of lanes");
}

}  // namespace linkstudy
