// All step loops there are: one for every mechanism for each instruction set and number of lanes,
// and those compiled for one structure that a program adds. Within an instruction set with fused
// instructions all of them give the same bits.
#pragma once

#include <span>

#include "core/simulation/kernel.h"

namespace linkstudy {

// To be called only on a machine that has the instruction set.
std::span<const Kernel> baseline_kernels();
std::span<const Kernel> avx2_kernels();
std::span<const Kernel> avx512_kernels();

// Adds kernels for single structures; before the first run, not thread-safe.
void add_kernels(std::span<const Kernel> kernels);

// The kernel for a mechanism: one made for its structure if there is one and `general` is false.
const Kernel& find_kernel(const Mechanism& mechanism, InstructionSet isa, int lanes,
                          bool general = false);

}  // namespace linkstudy
