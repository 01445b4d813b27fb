// Trials for every mechanism, on packs of one instruction set.
#pragma once

#include <cstring>

#include "core/simulation/kernel.h"
#include "core/simulation/pack_parameters.h"
#include "core/simulation/trial_step.h"

namespace linkstudy {

template <class Real>
class GeneralTrials final : public TrialPack {
 public:
  static constexpr int lanes = RealTraits<Real>::lanes;
  static constexpr int width = slot_numbers(lanes);

  GeneralTrials(const Mechanism& m, const TrialSlots& slots, const LaneCase* cases, int count)
      : slots_(slots), p_(pack_parameters<Real>(cases, count)), trial_(m, p_) {}

  void set_parameters(int i, const Parameters<double>& p) override {
    set_lane_parameters<Real>(p_, i, p);
  }

  void run(double* frame) override {
    trial_.for_read(slots_, [frame](int slot, Real* x, int n) {
      for (int k = 0; k < n; ++k) x[k] = get(frame + (slot + k) * width);
    });
    trial_.advance();
    trial_.for_written(slots_, [frame](int slot, const Real* x, int n) {
      for (int k = 0; k < n; ++k) put(frame + (slot + k) * width, x[k]);
    });
  }

 private:
  static Real get(const double* place) {
    Real x;
    if constexpr (lanes == width) {
      std::memcpy(&x, place, width * sizeof(double));
    } else {
      for (int i = 0; i < lanes; ++i) set_lane(x, i, place[i]);
    }
    return x;
  }
  static void put(double* place, const Real& x) {
    if constexpr (lanes == width) {
      std::memcpy(place, &x, width * sizeof(double));
    } else {
      for (int i = 0; i < lanes; ++i) place[i] = lane(x, i);
    }
  }

  const TrialSlots slots_;
  Parameters<Real> p_;
  TrialStep<Real> trial_;
};

template <class Real>
TrialPack* make_general_trials(const Mechanism& m, const TrialSlots& slots, const LaneCase* cases,
                               int count) {
  return new GeneralTrials<Real>(m, slots, cases, count);
}

}  // namespace linkstudy
