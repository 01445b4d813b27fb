// The lanes of a run on the frame of a written step: what goes in and comes out.
// A step that fails for a lane has changed nothing outside the frame: the general step loop takes
// it from the same state. Code that fails again and again is left, for other code or none.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

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
  static constexpr int width = slot_numbers(lanes);

  // What stays the same during a run goes along; p and code have to outlive it. `pack`: which of
  // those that go side by side.
  WrittenLanes(const SharedCode<Real>& code, int pack, double h, double drift_limit,
               const Parameters<Real>& p)
      : shared_(code), pack_(pack), h_(h), drift_limit_(drift_limit), p_(p) {
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

  // True if there is other code now than was asked last, with a frame of its own, or none any more.
  bool takes_other_code() {
    if (code_ == shared_.get()) return false;
    take_code();
    return true;
  }

  // Where the code reads the state y from, as numbers of the run; null if it cannot stay there.
  Real* state() const {
    if constexpr (lanes == width) {
      return code_ == nullptr ? nullptr : reinterpret_cast<Real*>(place(code_->slots.state));
    } else {
      return nullptr;
    }
  }

  // for_state(f) calls f(numbers, how many), as for_state_numbers does.
  template <class ForState>
  void read(double t, Real initial_energy, ForState&& for_state) {
    put(StepSlots::t, Real(t));
    put(StepSlots::initial_energy, initial_energy);
    put_all(code_->slots.state, for_state);
  }

  // Of a step that has been run: lanes for which all is well, one bit each.
  unsigned fine() const {
    if constexpr (lanes == width) {
      typename RealTraits<Real>::Mask mask;
      std::memcpy(&mask, place(code_->slots.fine), sizeof mask);
      return lane_bits(mask);
    } else {
      unsigned bits = 0;
      for (int k = 0; k < lanes; ++k) {
        std::uint64_t mask = 0;
        std::memcpy(&mask, place(code_->slots.fine) + k, sizeof mask);
        bits |= static_cast<unsigned>(mask & 1u) << k;
      }
      return bits;
    }
  }

  template <class W>
  void write_kept(W& w) const {
    const double* at = place(code_->slots.kept);
    for_kept_numbers<Real>(w, [&at](Real* x, std::size_t n) { get_all(at, x, n); });
  }

  // Channel i of an observer.
  Real observed(int observer, std::size_t i) const {
    return get(
        place(code_->slots.observed + code_->first_observed[observer] + static_cast<int>(i)));
  }

  template <class ForState>
  void write_next(ForState&& for_state) const {
    const double* at = place(code_->slots.next);
    for_state([&at](Real* x, std::size_t n) { get_all(at, x, n); });
  }

 private:
  void take_code() {
    code_ = shared_.get();
    if (code_ == nullptr) return;
    frame_ = code_->frame + pack_ * code_->frame_numbers;
    put(StepSlots::h, Real(h_));
    put(StepSlots::drift_limit, Real(drift_limit_));
    put_all(StepSlots::parameters,
            [this](auto&& f) { for_parameter_numbers<Real>(p_, std::forward<decltype(f)>(f)); });
  }

  double* place(int slot) const { return frame_ + slot * width; }

  // What stands there already stays.
  template <class ForNumbers>
  void put_all(int slot, ForNumbers&& for_numbers) const {
    double* at = place(slot);
    for_numbers([&at](const Real* x, std::size_t n) {
      double* const end = at + n * width;
      if (static_cast<const void*>(x) == at) at = end;
      for (; at != end; at += width, ++x) put_at(at, *x);
      at = end;
    });
  }
  void put(int slot, const Real& x) const { put_at(place(slot), x); }

  static void put_at(double* at, const Real& x) {
    if constexpr (lanes == width) {
      std::memcpy(at, &x, width * sizeof(double));
    } else {
      for (int k = 0; k < width; ++k) at[k] = lane(x, k < lanes ? k : lanes - 1);
    }
  }

  static void get_all(const double*& at, Real* x, std::size_t n) {
    const double* const end = at + n * width;
    for (; at != end; at += width, ++x) *x = get(at);
  }
  static Real get(const double* at) {
    Real x;
    if constexpr (lanes == width) {
      std::memcpy(&x, at, width * sizeof(double));
    } else {
      for (int k = 0; k < lanes; ++k) set_lane(x, k, at[k]);
    }
    return x;
  }

  const SharedCode<Real>& shared_;
  const int pack_;
  const double h_, drift_limit_;
  const Parameters<Real>& p_;
  const StepCode* code_ = nullptr;  // that the frame was last filled for
  double* frame_ = nullptr;
};

}  // namespace linkstudy
