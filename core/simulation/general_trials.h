// Trials of adaptive steps, and instants inside them, for every mechanism, on packs of one
// instruction set.
#pragma once

#include <cstring>

#include "core/simulation/inside_step.h"
#include "core/simulation/kernel.h"
#include "core/simulation/pack_parameters.h"
#include "core/simulation/trial_step.h"

namespace linkstudy {

template <class Real>
class GeneralTrials final : public TrialPack {
 public:
  static constexpr int lanes = RealTraits<Real>::lanes;
  static constexpr int width = slot_numbers(lanes);

  GeneralTrials(const Mechanism& m, const TrialSetting& setting, const LaneCase* cases, int count)
      : slots_(setting.slots),
        p_(pack_parameters<Real>(cases, count)),
        trial_(m, p_),
        inside_(m, p_, setting.observed, setting.observed_count) {}

  void set_parameters(int i, const Parameters<double>& p) override {
    set_lane_parameters<Real>(p_, i, p);
  }

  void try_steps(double* frame) override {
    read(frame, trial_);
    trial_.advance();
    write(trial_, frame);
  }

  void look_inside(double* frame) override {
    read(frame, inside_);
    inside_.look();
    write(inside_, frame);
  }

 private:
  template <class Part>
  void read(const double* frame, Part& part) const {
    part.for_read(slots_, [frame](int slot, Real* x, int n) {
      for (int k = 0; k < n; ++k) x[k] = get(frame + (slot + k) * width);
    });
  }
  template <class Part>
  void write(Part& part, double* frame) const {
    part.for_written(slots_, [frame](int slot, const Real* x, int n) {
      for (int k = 0; k < n; ++k) put(frame + (slot + k) * width, x[k]);
    });
  }
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
  InsideStep<Real> inside_;
};

template <class Real>
TrialPack* make_general_trials(const Mechanism& m, const TrialSetting& setting,
                               const LaneCase* cases, int count) {
  return new GeneralTrials<Real>(m, setting, cases, count);
}

}  // namespace linkstudy
