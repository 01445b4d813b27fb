// Which instruction set the step loop runs on: the widest that machine and build have, unless the
// environment variable LINKSTUDY_SIMD says `baseline`, `avx2` or `avx512` (a set that is not there
// is an error), and how many cases a pack holds: its native width, or 1 with LINKSTUDY_LANES=1.
#pragma once

#include <stdexcept>

#include "core/base/words.h"

namespace linkstudy {

enum class InstructionSet { baseline, avx2, avx512 };

template <>
inline constexpr auto kWords<InstructionSet> =
    make_words<InstructionSet>({{InstructionSet::baseline, "baseline"},
                                {InstructionSet::avx2, "avx2"},
                                {InstructionSet::avx512, "avx512"}});

struct SimdLevel {
  InstructionSet isa = InstructionSet::baseline;
  int lanes = 1;
};

// What the environment asks for was not possible.
struct SimdError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Decided once a process. Throws SimdError.
SimdLevel simd_level();

// The decision itself, for values of the two variables (null: not set).
SimdLevel choose_simd_level(const char* simd, const char* lanes);

bool machine_has(InstructionSet isa);

}  // namespace linkstudy
