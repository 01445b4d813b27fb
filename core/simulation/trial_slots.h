// Trials of adaptive steps side by side, each lane with a time and a length of its own, and
// instants inside these steps: what they read and write in a frame of numbers
// (core/codegen/frame_code.h). The general loop (core/simulation/trial_step.h, inside_step.h),
// written code and the runs that ask (core/simulation/located_run.h) agree on every slot.
#pragma once

#include "core/simulation/run_state.h"

namespace linkstudy {

// Whether accepted states are settled (settle_state) before a run goes on from them.
[[gnu::always_inline]] inline bool is_settled(const Mechanism& m) {
  return m.projects || !m.ball_q.empty();
}

struct TrialSlots {
  // Read: time, length of the step, the last instant that courses are seen at, tolerances.
  static constexpr int t = 0, h = 1, last = 2, absolute = 3, relative = 4;
  // Of an instant: time, which part of the step is gone, energy of the ledger at the start.
  static constexpr int instant = 5, part = 6, initial_energy = 7;
  static constexpr int parameters = 8;
  int memory, y, slope;  // of contacts; state and slopes at t
  // Written: the largest error over what is allowed; state and slopes at the end, and what gives
  // the solution between (core/numerics/dormand_prince.h, d_1 to d_4 one after another).
  int error, end, end_slope, inside;
  // Depth and rate of each contact at the quarters of the step and at its end, and the drift there.
  int quarters, near, drift;
  // Of linkages whose states are settled: the same at the end, settled.
  int settled, settled_slope, settled_near, settled_drift;
  int fine;  // a mask
  // Of an instant: 1 where the state is that of a motion, drift, independent cut rows, energies
  // (kinetic, of weight, elastic, supplied, dissipated), channels of observers, a mask.
  int moves, instant_drift, rank, energies, samples, instant_fine;
  int count;

  // How many parameters there are, and channels.
  TrialSlots(const Mechanism& m, int numbers, int channels) {
    const int n = state_size(m), of_contacts = 2 * m.contact_count();
    int next = parameters + numbers;
    const auto take = [&next](int slots) {
      next += slots;
      return next - slots;
    };
    memory = take(kMemoryNumbers * m.contact_count());
    y = take(n);
    slope = take(n);
    error = take(1);
    end = take(n);
    end_slope = take(n);
    inside = take(4 * n);
    quarters = take(3 * of_contacts);
    near = take(of_contacts);
    drift = take(1);
    const bool settles = is_settled(m);
    settled = take(settles ? n : 0);
    settled_slope = take(settles ? n : 0);
    settled_near = take(settles ? of_contacts : 0);
    settled_drift = take(settles ? 1 : 0);
    fine = take(1);
    moves = take(1);
    instant_drift = take(1);
    rank = take(1);
    energies = take(kEnergies);
    samples = take(channels);
    instant_fine = take(1);
    count = next;
  }

  static constexpr int kMemoryNumbers = 5, kEnergies = 5;
};

}  // namespace linkstudy
