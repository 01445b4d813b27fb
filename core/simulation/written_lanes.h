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

// The code that the runs on a frame share.
template <class Real>
class SharedCode {
 public:
  explicit SharedCode(const StepCode* code) : code_(code) {}

  const StepCode* get() const { return code_; }
  void run() { code_->code->run(code_->frame); }

  // Whether a step was fine for all who asked; they have taken what they need of it.
  void note(bool is_fine) {
    if (!failures_.note(is_fine)) return;
    code_ = code_->instead != nullptr ? code_->instead(code_->context) : nullptr;
    failures_ = {};
  }

 private:
  const StepCode* code_;
  CodeFailures failures_;
};

template <class Real>
class WrittenLanes {
 public:
  static constexpr int lanes = RealTraits<Real>::lanes;

  // What stays the same during a run goes along; p and code have to outlive it. `first`: of its
  // lanes, among the numbers of a slot.
  WrittenLanes(const SharedCode<Real>& code, int first, double h, double drift_limit,
               const Parameters<Real>& p)
      : shared_(code), first_(first), h_(h), drift_limit_(drift_limit), p_(p) {
    take_code();
  }

  bool is_there() const { return shared_.get() != nullptr; }

  // Observers look in this step at what the code does not write.
  bool leaves_out(long step) const {
    const StepCode& code = *shared_.get();
    for (int i = 0; i < code.beyond_count; ++i)
      if (code.beyond[i].hits(step)) return true;
    return false;
  }

  // for_state(f) calls f(numbers, how many), as for_state_numbers does.
  template <class ForState>
  void read(double t, Real initial_energy, ForState&& for_state) {
    if (code_ != shared_.get()) take_code();
    put(StepSlots::t, Real(t));
    put(StepSlots::initial_energy, initial_energy);
    double* at = place(code_->slots.state);
    for_state([this, &at](const Real* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k, at += stride_) put_at(at, x[k]);
    });
  }

  // Of a step that has been run: lanes for which all is well, one bit each.
  unsigned fine() const {
    if constexpr (lanes > 1) {
      typename RealTraits<Real>::Mask mask;
      std::memcpy(&mask, place(code_->slots.fine), sizeof mask);
      return lane_bits(mask);
    } else {
      std::uint64_t mask = 0;
      std::memcpy(&mask, place(code_->slots.fine), sizeof mask);
      return static_cast<unsigned>(mask & 1u);
    }
  }

  template <class W>
  void write_kept(W& w) const {
    const double* at = place(code_->slots.kept);
    for_kept_numbers<Real>(w, [this, &at](Real* x, std::size_t n) { get_all(at, x, n); });
  }

  // Channel i of an observer.
  Real observed(int observer, std::size_t i) const {
    Real x;
    get_at(place(code_->slots.observed + code_->first_observed[observer] + static_cast<int>(i)), x);
    return x;
  }

  template <class ForState>
  void write_next(ForState&& for_state) const {
    const double* at = place(code_->slots.next);
    for_state([this, &at](Real* x, std::size_t n) { get_all(at, x, n); });
  }

 private:
  void take_code() {
    code_ = shared_.get();
    if (code_ == nullptr) return;
    stride_ = code_->slot_numbers;
    put(StepSlots::h, Real(h_));
    put(StepSlots::drift_limit, Real(drift_limit_));
    double* at = place(StepSlots::parameters);
    for_parameter_numbers<Real>(p_, [this, &at](const Real* x, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k, at += stride_) put_at(at, x[k]);
    });
  }

  double* place(int slot) const { return code_->frame + slot * stride_ + first_; }

  // One lane stands alone in its slots, and what is beside it does the same.
  void put_at(double* at, const Real& x) const {
    if constexpr (lanes > 1) {
      std::memcpy(at, &x, sizeof x);
    } else {
      for (int k = 0; k < stride_; ++k) at[k] = lane(x, 0);
    }
  }
  void put(int slot, const Real& x) { put_at(place(slot), x); }

  static void get_at(const double* at, Real& x) {
    if constexpr (lanes > 1) {
      std::memcpy(&x, at, sizeof x);
    } else {
      set_lane(x, 0, *at);
    }
  }
  void get_all(const double*& at, Real* x, std::size_t n) const {
    for (std::size_t k = 0; k < n; ++k, at += stride_) get_at(at, x[k]);
  }

  const SharedCode<Real>& shared_;
  const int first_;
  const double h_, drift_limit_;
  const Parameters<Real>& p_;
  const StepCode* code_ = nullptr;  // that the frame was last filled for
  int stride_ = 0;
};

}  // namespace linkstudy
