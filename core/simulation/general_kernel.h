// The step loop and adaptive trials for every mechanism, on packs of one instruction set.
#pragma once

#include <array>

#include "core/base/pack.h"
#include "core/simulation/general_trials.h"
#include "core/simulation/run.h"

namespace linkstudy {

template <class Isa, int Lanes>
void run_general(const Mechanism& m, const KernelRun& setting, const LaneCase* cases, int count) {
  Run<Pack<Lanes, Isa>>(m, setting, cases, count).run();
}

template <class Isa>
constexpr std::array<Kernel, 2> general_kernels(InstructionSet isa) {
  return {{{isa, 1, run_general<Isa, 1>, make_general_trials<Pack<1, Isa>>},
           {isa, Isa::lanes, run_general<Isa, Isa::lanes>,
            make_general_trials<Pack<Isa::lanes, Isa>>}}};
}

}  // namespace linkstudy
