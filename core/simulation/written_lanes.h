// The lanes of a run on the frame of a written step: what goes in and comes out.
// A step that fails for a lane has changed nothing outside the frame: the general step loop takes
// it from the same state. Code that fails again and again is left, for other code or none.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/base/real.h"
#include "core/simulation/code_failures.h"
#include "core/simulation/kernel.h"

namespace linkstudy {

template <class Real>
class WrittenLanes {
 public:
  static constexpr int lanes = RealTraits<Real>::lanes;
  static constexpr int width = slot_numbers(lanes);

  // What stays the same during a run goes along; p has to outlive it.
  WrittenLanes(const StepCode* code, double h, double drift_limit, const Parameters<Real>& p)
      : h_(h), drift_limit_(drift_limit), p_(p) {
    take(code);
  }

  bool is_there() const { return code_ != nullptr; }

  // Observers look in this step at what the code does not write.
  bool leaves_out(long step) const {
    for (int i = 0; i < code_->beyond_count; ++i)
      if (code_->beyond[i].hits(step)) return true;
    return false;
  }

  // for_state(f) calls f(numbers, how many), as for_state_numbers does.
  template <class ForState>
  void read(double t, Real initial_energy, ForState&& for_state) {
    put(StepSlots::t, Real(t));
    put(StepSlots::initial_energy, initial_energy);
    int slot = code_->slots.state;
    for_state([&](const Real* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) put(slot++, x[k]);
    });
  }

  // True if all is well for the lanes asked for, one bit each.
  bool run(unsigned active) {
    code_->code->run(code_->frame);
    const bool is_fine = (fine() & active) == active;
    if (failures_.note(is_fine)) leave();
    return is_fine;
  }

  template <class W>
  void write_kept(W& w) const {
    int slot = code_->slots.kept;
    for_kept_numbers<Real>(w, [&](Real* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) x[k] = get(slot++);
    });
  }

  // Channel i of an observer.
  Real observed(int observer, std::size_t i) const {
    return get(code_->slots.observed + code_->first_observed[observer] + static_cast<int>(i));
  }

  template <class ForState>
  void write_next(ForState&& for_state) const {
    int slot = code_->slots.next;
    for_state([&](Real* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) x[k] = get(slot++);
    });
  }

 private:
  void take(const StepCode* code) {
    code_ = code;
    failures_ = {};
    if (code_ == nullptr) return;
    put(StepSlots::h, Real(h_));
    put(StepSlots::drift_limit, Real(drift_limit_));
    int slot = StepSlots::parameters;
    for_parameter_numbers<Real>(p_, [&](const Real* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) put(slot++, x[k]);
    });
  }

  void leave() { take(code_->instead != nullptr ? code_->instead(code_->context) : nullptr); }

  double* place(int slot) const { return code_->frame + slot * width; }

  void put(int slot, const Real& x) {
    if constexpr (lanes == width) {
      std::memcpy(place(slot), &x, width * sizeof(double));
    } else {
      for (int k = 0; k < width; ++k) place(slot)[k] = lane(x, k < lanes ? k : lanes - 1);
    }
  }

  Real get(int slot) const {
    Real x;
    if constexpr (lanes == width) {
      std::memcpy(&x, place(slot), width * sizeof(double));
    } else {
      for (int k = 0; k < lanes; ++k) set_lane(x, k, place(slot)[k]);
    }
    return x;
  }

  unsigned fine() const {
    unsigned bits = 0;
    for (int k = 0; k < lanes; ++k) {
      std::uint64_t mask = 0;
      std::memcpy(&mask, place(code_->slots.fine) + k, sizeof mask);
      bits |= static_cast<unsigned>(mask & 1u) << k;
    }
    return bits;
  }

  const double h_, drift_limit_;
  const Parameters<Real>& p_;
  const StepCode* code_ = nullptr;
  CodeFailures failures_;
};

}  // namespace linkstudy
