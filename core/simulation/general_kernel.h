// The step loop and adaptive trials for every mechanism, on packs of one instruction set.
#pragma once

#include <algorithm>
#include <array>

#include "core/base/pack.h"
#include "core/simulation/general_trials.h"
#include "core/simulation/run.h"

namespace linkstudy {

template <class Isa, int Lanes>
void run_general(const Mechanism& m, const KernelRun& setting, const LaneCase* cases, int count) {
  using Real = Pack<Lanes, Isa>;
  SharedCode<Real> code(setting.code);
  Run<Real> first(m, setting, {cases, std::min(count, Lanes), 0}, code);
  if (count <= Lanes) return run_alone(first, code);
  Run<Real> second(m, setting, {cases + Lanes, count - Lanes, 1}, code);
  run_beside(first, second, code);
}

template <class Isa, int... Lanes>
constexpr std::array<Kernel, sizeof...(Lanes)> general_kernels(InstructionSet isa) {
  return {{{isa, Lanes, run_general<Isa, Lanes>, make_general_trials<Pack<Lanes, Isa>>}...}};
}

}  // namespace linkstudy
