// The step loop, compiled for each instruction set and number of lanes. Within an instruction set
// with fused instructions all of them give the same bits.
#pragma once

#include <span>

#include "core/simulation/kernel.h"

namespace linkstudy {

// To be called only on a machine that has the instruction set.
std::span<const Kernel> baseline_kernels();
std::span<const Kernel> avx2_kernels();
std::span<const Kernel> avx512_kernels();

const Kernel& find_kernel(InstructionSet isa, int lanes);

}  // namespace linkstudy
