// An instant inside an adaptive step, on any scalar: the state there settled, evaluated, and what
// observers and checks ask of it. Reads and writes slots of core/simulation/trial_slots.h.
#pragma once

#include "core/numerics/dormand_prince.h"
#include "core/simulation/instant.h"
#include "core/simulation/run_checks.h"
#include "core/simulation/trial_slots.h"

namespace linkstudy {

template <class Real>
class InsideStep {
 public:
  InsideStep(const Mechanism& m, const Parameters<Real>& p, const Channel* observed, int count)
      : m_(m),
        p_(p),
        observed_(observed),
        w_(make_workspace<Real>(m)),
        method_(static_cast<std::size_t>(state_size(m))),
        y_(method_.size()),
        correction_(static_cast<std::size_t>(m.nv)),
        samples_(static_cast<std::size_t>(count)),
        now_(m_, p_, w_),
        checks_(m_, p_) {}

  // For a trace that is to hold where cut rows do not depend on each other.
  void take_rows_as_clear() { w_.rows_may_depend = false; }

  // f(first slot, numbers, how many) of what it reads, parameters aside.
  template <class F>
  void for_read(const TrialSlots& s, F&& f) {
    const int n = static_cast<int>(method_.size());
    f(TrialSlots::instant, &t_, 1);
    f(TrialSlots::part, &part_, 1);
    f(TrialSlots::initial_energy, &initial_energy_, 1);
    f(s.memory, numbers_in<Real>(w_.memory), TrialSlots::kMemoryNumbers * m_.contact_count());
    f(s.y, method_.begin(), n);
    for (int k = 0; k < DormandPrinceStep<Real>::powers; ++k) {
      f(s.inside + k * n, method_.inside(k), n);
    }
  }

  // The same of what it writes.
  template <class F>
  void for_written(const TrialSlots& s, F&& f) {
    f(s.moves, &moves_, 1);
    f(s.instant_drift, &drift_, 1);
    f(s.rank, &w_.kept_rows, 1);
    f(s.energies, energies_.data(), TrialSlots::kEnergies);
    f(s.samples, samples_.data(), static_cast<int>(samples_.size()));
  }

  // 1 where the state is that of a motion.
  const Real& moves() const { return moves_; }

  void look() {
    method_.write_inside(part_, y_.data());
    evaluate_there();
    moves_ = select(checks_.moves(m_, y_.data(), w_), Real(1.0), Real(0.0));
    for (int i = 0; i < RealTraits<Real>::lanes; ++i)
      if ((w_.jammed >> i & 1u) != 0) set_lane(moves_, i, 0.0);
    drift_ = drift_of(m_, w_);
    now_.move_to(t_, y_.data());
    now_.set_initial_energy(initial_energy_);
    const Energy<Real> e = now_.energy();
    energies_ = {e.kinetic, e.height, e.elastic, now_.supplied(), now_.dissipated()};
    for (const int i : indices_of(samples_)) samples_[i] = now_.sample(observed_[i]);
  }

 private:
  [[gnu::noinline]] void evaluate_there() {
    settle_state(m_, p_, t_, y_.data(), correction_.data(), w_);
    evaluate_state(m_, p_, t_, y_.data(), w_);
  }

  const Mechanism& m_;
  const Parameters<Real>& p_;
  const Channel* observed_;
  Workspace<Real> w_;
  DormandPrinceStep<Real> method_;
  std::vector<Real> y_, correction_, samples_;
  Instant<Real> now_;
  RunChecks<Real> checks_;
  Real t_ = Real(0.0), part_ = Real(0.0), initial_energy_ = Real(0.0);
  Real moves_ = Real(0.0), drift_ = Real(0.0);
  std::array<Real, TrialSlots::kEnergies> energies_{};
};

}  // namespace linkstudy
