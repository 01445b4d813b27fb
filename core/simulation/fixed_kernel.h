// The step loop for one structure that is part of the type, on packs of one instruction set. Its
// source is written when the program is built (study/specialize).
#pragma once

#include <array>

#include "core/base/pack.h"
#include "core/simulation/run.h"

namespace linkstudy {

template <class M, class Isa, int Lanes>
void run_fixed(const Mechanism&, const KernelRun& setting, const LaneCase* cases, int count) {
  static constexpr M structure;
  Run<Pack<Lanes, Isa>, M>(structure, setting, cases, count).run();
}

template <class M, class Isa>
constexpr std::array<Kernel, 2> fixed_kernels(InstructionSet isa,
                                              bool (*serves)(const Mechanism&)) {
  return {{{isa, 1, serves, run_fixed<M, Isa, 1>},
           {isa, Isa::lanes, serves, run_fixed<M, Isa, Isa::lanes>}}};
}

}  // namespace linkstudy
