// A whole step of the classical Runge-Kutta method as one function on a frame of numbers: what it
// reads and writes, in which order. The same functions walk the numbers of a trace
// (core/simulation/step_trace.h) and those of a run, so both agree on every slot.
//   reads   t, h, drift limit; parameters; the state of the run: y, contacts' memories, their
//   steps,
//           their log, greatest drift
//   writes  the state after the step; a mask, true in the lanes for which all is well; what the run
//           looks at in the evaluation at the start of the step
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/forces/contact_log.h"
#include "core/simulation/parameter_numbers.h"

namespace linkstudy {

// What of an evaluation is kept for observers: accelerations, contacts and joint friction; closures
// too; all that any channel is made of.
enum class Kept : std::uint8_t { motion, closures, everything };

struct StepSlots {
  static constexpr int t = 0, h = 1, drift_limit = 2, parameters = 3;
  int state = 0;  // before the step, then after it
  int next = 0;
  int fine = 0;
  int kept = 0;
  int end = 0;  // how many there are
};

// f(numbers, how many) of the state of a run.
template <class Real, class Y, class Memory, class Steps, class F>
inline void for_state_numbers(Y& y, Memory& memory, Steps& steps, ContactLog<Real>& log,
                              Real& drift_max, F&& f) {
  f(y.data(), y.size());
  f(numbers_in<Real>(memory), number_count<Real>(memory));
  f(steps.data(), steps.size());
  f(&log.begun, std::size_t{1});
  f(&log.least_steps, std::size_t{1});
  f(&drift_max, std::size_t{1});
}

// f(numbers, how many) of what is kept of an evaluation.
template <class Real, class W, class F>
inline void for_kept_numbers(Kept kept, W& w, F&& f) {
  const auto pass = [&](auto& list) { f(numbers_in<Real>(list), number_count<Real>(list)); };
  pass(w.qdd);
  pass(w.contacts);
  pass(w.frictions);
  if (kept == Kept::motion) return;
  pass(w.closures);
  if (kept == Kept::closures) return;
  pass(w.bodies);
  pass(w.axes);
  pass(w.link_loads);
  pass(w.cut_rows);
  pass(w.sde_rows);
}

}  // namespace linkstudy
