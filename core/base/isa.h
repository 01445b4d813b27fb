// Which instruction set the step loop runs on: the widest that machine and build have, unless the
// environment variable LINKSTUDY_SIMD says `baseline`, `avx2` or `avx512` (a set that is not there
// is an error), and how many cases a pack holds: its native width, or 1 with LINKSTUDY_LANES=1.
// LINKSTUDY_KERNELS=general runs no code that the program has written for a linkage (core/codegen),
// LINKSTUDY_KERNELS=written writes it even for a run too short to gain by it, and for two packs
// side by side whether they gain or not.
#pragma once

#include <stdexcept>

#include "core/base/words.h"

namespace linkstudy {

enum class InstructionSet { baseline, avx2, avx512 };

// Doubles that a vector register holds, and how many registers there are.
constexpr int native_lanes(InstructionSet isa) {
  return isa == InstructionSet::avx512 ? 8 : isa == InstructionSet::avx2 ? 4 : 2;
}
constexpr int vector_registers(InstructionSet isa) {
  return isa == InstructionSet::avx512 ? 32 : 16;
}

template <>
inline constexpr auto kWords<InstructionSet> =
    make_words<InstructionSet>({{InstructionSet::baseline, "baseline"},
                                {InstructionSet::avx2, "avx2"},
                                {InstructionSet::avx512, "avx512"}});

enum class Kernels { automatic, written, general };

template <>
inline constexpr auto kWords<Kernels> = make_words<Kernels>({{Kernels::automatic, "automatic"},
                                                             {Kernels::written, "written"},
                                                             {Kernels::general, "general"}});

struct SimdLevel {
  InstructionSet isa = InstructionSet::baseline;
  int lanes = 1;
  Kernels kernels = Kernels::automatic;
};

// What the environment asks for was not possible.
struct SimdError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Decided once a process. Throws SimdError.
SimdLevel simd_level();

// The decision itself, for values of the variables (null: not set).
SimdLevel choose_simd_level(const char* simd, const char* lanes, const char* kernels = nullptr);

bool machine_has(InstructionSet isa);

}  // namespace linkstudy
