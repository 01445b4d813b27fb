// A whole step of the classical Runge-Kutta method as one function on a frame of numbers: what it
// reads and writes, in which order. The same functions walk the numbers of a trace
// (core/simulation/step_trace.h) and those of a run, so both agree on every slot.
//   reads   t, h, drift limit, energy at the start; parameters; the state of the run: y, greatest
//           drift, contacts' memories, their steps, their log
//   writes  the state after the step; a mask, true in the lanes for which all is well; contacts and
//           joint friction before the step, what springs weigh, and the channels that observers
//           look at
#pragma once

#include <cstddef>

#include "core/forces/contact_log.h"
#include "core/model/parameter_numbers.h"

namespace linkstudy {

struct StepSlots {
  static constexpr int t = 0, h = 1, drift_limit = 2, initial_energy = 3, parameters = 4;
  int state = 0;  // before the step, then after it
  int next = 0;
  int fine = 0;
  int kept = 0;
  int observed = 0;
  int end = 0;  // how many there are
};

// f(numbers, how many) of the state of a run.
template <class Real, class Y, class Memory, class Steps, class F>
inline void for_state_numbers(Y& y, Memory& memory, Steps& steps, ContactLog<Real>& log,
                              Real& drift_max, F&& f) {
  f(y.data(), y.size());
  f(&drift_max, std::size_t{1});
  if (steps.size() == 0) return;  // no contacts
  f(numbers_in<Real>(memory), number_count<Real>(memory));
  f(steps.data(), steps.size());
  f(&log.begun, std::size_t{1});
  f(&log.least_steps, std::size_t{1});
}

// f(numbers, how many) of what a run keeps of an evaluation (core/simulation/step_watch.h).
template <class Real, class W, class F>
inline void for_kept_numbers(W& w, F&& f) {
  f(numbers_in<Real>(w.contacts), number_count<Real>(w.contacts));
  f(numbers_in<Real>(w.frictions), number_count<Real>(w.frictions));
  f(numbers_in<Real>(w.constant_frictions), number_count<Real>(w.constant_frictions));
  f(numbers_in<Real>(w.spring_weights), number_count<Real>(w.spring_weights));
  f(&w.kept_rows, std::size_t{1});
}

}  // namespace linkstudy
