// A trial of an adaptive step by the method of Dormand and Prince, on any scalar: what the slots of
// core/simulation/trial_slots.h say, between reading and writing them.
#pragma once

#include "core/numerics/dormand_prince.h"
#include "core/simulation/contact_nearness.h"
#include "core/simulation/run_checks.h"
#include "core/simulation/trial_slots.h"

namespace linkstudy {

template <class Real>
class TrialStep {
 public:
  TrialStep(const Mechanism& m, const Parameters<Real>& p)
      : m_(m),
        p_(p),
        w_(make_workspace<Real>(m)),
        method_(static_cast<std::size_t>(state_size(m))),
        inside_(method_.size(), Real(0.0)),
        settled_(is_settled(m) ? method_.size() : 0, Real(0.0)),
        settled_slope_(settled_),
        correction_(static_cast<std::size_t>(m.nv)),
        quarters_(6 * m.contacts.size()),
        near_(2 * m.contacts.size()),
        settled_near_(2 * m.contacts.size()) {
    static_assert(sizeof(ContactMemory<Real>) == TrialSlots::kMemoryNumbers * sizeof(Real));
  }

  // For a trace that is to hold where cut rows do not depend on each other.
  void take_rows_as_clear() { w_.rows_may_depend = false; }

  // f(first slot, numbers, how many) of what a trial reads, parameters aside.
  template <class F>
  void for_read(const TrialSlots& s, F&& f) {
    f(TrialSlots::t, &t_, 1);
    f(TrialSlots::h, &h_, 1);
    f(TrialSlots::last, &last_, 1);
    f(TrialSlots::absolute, &absolute_, 1);
    f(TrialSlots::relative, &relative_, 1);
    f(s.memory, numbers_in<Real>(w_.memory), TrialSlots::kMemoryNumbers * m_.contact_count());
    f(s.y, method_.begin(), size());
    f(s.slope, method_.first_slope(), size());
  }

  // The same of what it writes.
  template <class F>
  void for_written(const TrialSlots& s, F&& f) {
    const int of_contacts = 2 * m_.contact_count();
    f(s.error, &error_, 1);
    f(s.end, method_.end(), size());
    f(s.end_slope, method_.last_slope(), size());
    for (int k = 0; k < 4; ++k) f(s.inside + k * size(), method_.inside(k), size());
    f(s.quarters, quarters_.data(), 3 * of_contacts);
    f(s.near, near_.data(), of_contacts);
    f(s.drift, &drift_, 1);
    if (!is_settled(m_)) return;
    f(s.settled, settled_.data(), size());
    f(s.settled_slope, settled_slope_.data(), size());
    f(s.settled_near, settled_near_.data(), of_contacts);
    f(s.settled_drift, &settled_drift_, 1);
  }

  // The largest over what is allowed.
  const Real& error() const { return error_; }

  void advance() {
    method_.advance(t_, h_, [this](Real t, Real* y, Real* slope) {
      impose_motions(m_, p_, t, y, y + m_.nq);
      differentiate(t, y, slope);
    });
    see(near_.data(), drift_);
    // Where contacts are, what they take is told apart without a say in the steps.
    const std::size_t counted = method_.size() - (m_.contact_count() > 0 ? 1 : 0);
    error_ = method_.error(counted, h_, [this](std::size_t, Real size_of) {
      return madd(relative_, size_of, absolute_);
    });
    if (m_.contact_count() > 0) look_at_quarters();
    if (is_settled(m_)) settle();
  }

 private:
  [[gnu::always_inline]] int size() const { return static_cast<int>(method_.size()); }

  [[gnu::noinline]] void differentiate(Real t, const Real* y, Real* slope) {
    evaluate_state(m_, p_, min(t, last_), y, w_);
    write_slopes(m_, y, w_, slope);
  }

  // Of the evaluation in w_.
  void see(Real* near, Real& drift) const {
    for (const ContactIndex i : indices_of(m_.contacts)) {
      near[2 * i.value()] = w_.contacts[i].depth;
      near[2 * i.value() + 1] = w_.contacts[i].rate;
    }
    drift = drift_of(m_, w_);
  }

  [[gnu::noinline]] void look_at_quarters() {
    for (int k = 0; k < 3; ++k) {
      Real* quarter = quarters_.data() + 2 * k * m_.contact_count();
      const Real part(0.25 * (k + 1));
      method_.write_inside(part, inside_.data());
      const Real t = madd(part, h_, t_);
      impose_motions(m_, p_, t, inside_.data(), inside_.data() + m_.nq);
      if (!m_.ball_q.empty()) normalize_quaternions(m_, inside_.data());
      for_nearness(m_, p_, inside_.data(), w_, [quarter](ContactIndex i, Real depth, Real rate) {
        quarter[2 * i.value()] = depth;
        quarter[2 * i.value() + 1] = rate;
      });
    }
  }

  [[gnu::noinline]] void settle() {
    const Real t = t_ + h_;
    for (int k = 0; k < size(); ++k) settled_[k] = method_.end()[k];
    settle_state(m_, p_, t, settled_.data(), correction_.data(), w_);
    differentiate(t, settled_.data(), settled_slope_.data());
    see(settled_near_.data(), settled_drift_);
  }

  const Mechanism& m_;
  const Parameters<Real>& p_;
  Workspace<Real> w_;
  DormandPrinceStep<Real> method_;
  std::vector<Real> inside_, settled_, settled_slope_, correction_;
  std::vector<Real> quarters_, near_, settled_near_;  // depth, rate
  Real t_ = Real(0.0), h_ = Real(0.0), last_ = Real(0.0);
  Real absolute_ = Real(0.0), relative_ = Real(0.0);
  Real error_ = Real(0.0), drift_ = Real(0.0), settled_drift_ = Real(0.0);
};

}  // namespace linkstudy
