// What the step loop watches of its own stiffness, lane by lane:
//   the rate sigma0 |v| / g(v) at which bristles relax, an eigenvalue of the equations of motion
//   that no single state tells of the others;
//   the states at which other eigenvalues are taken when the run is over (looks.h);
//   whether bristles keep to their law: |z| <= mu_s / sigma0 holds for ever once it holds
//   (core/laws/lugre_friction.h). A stable step may overshoot what a bristle tends to by as much as
//   it was away from it, so twice that is allowed; a step too long for it goes beyond. States whose
//   bristles are bent too far tell nothing of stiffness.
#pragma once

#include <algorithm>

#include "core/model/bristles.h"
#include "core/model/contact_of.h"
#include "core/simulation/kernel.h"
#include "core/simulation/looks.h"

namespace linkstudy {

template <class Real>
class StepWatch {
 public:
  using Mask = typename RealTraits<Real>::Mask;

  StepWatch(const Mechanism& m, const Parameters<Real>& p, const LaneCase* cases, int count,
            long steps)
      : m_(m),
        p_(p),
        cases_(cases),
        count_(count),
        stride_(std::max(1L, steps / kEvenLooks)),
        next_(stride_),
        heaviest_(static_cast<std::size_t>(look_count(m) - kEvenLooks), Real(0.0)),
        inverse_bound_(static_cast<std::size_t>(m.nz)) {
    bound_bristles();
  }

  // One of the even looks.
  bool looks_at(long step) const { return step == next_; }

  // z: bristles of an accepted state.
  Mask bristles_hold(Bristles<const Real> z) const { return bent(z) <= Real(kFarthest); }

  // An accepted state and its evaluation, in the lanes that still run.
  void see(long step, double t, const Real* y, const Workspace<Real>& w, unsigned active) {
    if (step == next_) look_evenly(step, t, y, w, active);
    if (look_count(m_) == kEvenLooks && m_.constant_frictions.empty()) return;
    const auto right = bent(y + m_.nq + m_.nv) <= Real(kRight);
    Real rate(0.0);
    const auto note = [&](int n, Real load) {
      const auto more = right && load > Real(kHeavier) * heaviest_[n];
      if (!any(more)) return;
      heaviest_[n] = select(more, load, heaviest_[n]);
      keep(kEvenLooks + n, lane_bits(more) & active, t, y, w);
    };
    for (const FrictionIndex i : indices_of(m_.frictions)) {
      rate = max(rate, w.frictions[i].relaxation);
      note(i.value(), w.frictions[i].load);
    }
    for (const ConstantFrictionIndex i : indices_of(m_.constant_frictions)) {
      rate = max(rate, w.constant_frictions[i].relaxation);
    }
    for (const ContactIndex i : indices_of(m_.contacts)) {
      const ContactState<Real>& s = w.contacts[i];
      const NormalContact<Real>& law = law_of_contact(m_, p_, i);
      rate = max(rate, s.relaxation);
      const int n = m_.friction_count() + 2 * i.value();
      note(n, s.elastic);
      note(n + 1, s.elastic * law.damping / max(s.approach, law.least_speed) + viscous(i, s));
    }
    for (const BendIndex i : indices_of(w.spring_weights)) {
      note(m_.friction_count() + 2 * m_.contact_count() + i.value(), w.spring_weights[i]);
    }
    const auto faster = right && rate > rate_;
    rate_ = select(faster, rate, rate_);
    rate_time_ = select(faster, Real(t), rate_time_);
  }

  // Hands over what lane i has shown so far.
  void store(int i, LaneEnd& end) const {
    end.bristle_rate = lane(rate_, i);
    end.bristle_time = lane(rate_time_, i);
  }

 private:
  static constexpr double kRight = 1.1, kFarthest = 2.0;  // times what a bristle can be bent
  static constexpr double kHeavier = 1.02;  // so that a load that grows is not kept at every step

  // Damping of a stop that does not follow the law of an impact, where it touches.
  Real viscous(ContactIndex contact, const ContactState<Real>& s) const {
    const StopIndex stop = m_.contacts[contact].stop;
    if (!stop.exists()) return Real(0.0);
    return select(s.elastic > Real(0.0), p_.stops[stop].damping, Real(0.0));
  }

  // Largest |z| in parts of what its law allows.
  Real bent(Bristles<const Real> z) const {
    Real most(0.0);
    for (const BristleIndex i : indices_of(inverse_bound_))
      most = max(most, abs(z[i]) * inverse_bound_[i]);
    return most;
  }

  void bound_bristles() {
    for_bristles(m_, p_, [this](BristleIndex z, const LugreParameters<Real>& law) {
      inverse_bound_[z] = law.sigma0 / law.mu_s;
    });
  }

  void look_evenly(long step, double t, const Real* y, const Workspace<Real>& w, unsigned active) {
    keep(static_cast<int>(step / stride_) - 1, active, t, y, w);
    next_ = step / stride_ < kEvenLooks ? step + stride_ : -1;
  }

  [[gnu::noinline]] void keep(int look, unsigned lanes, double t, const Real* y,
                              const Workspace<Real>& w) const {
    const int size = state_size(m_);
    for (int i = 0; i < count_; ++i) {
      if ((lanes >> i & 1u) == 0 || cases_[i].looks == nullptr) continue;
      double* row = cases_[i].looks + look * look_size(m_);
      *row++ = t;
      for (int k = 0; k < size; ++k) *row++ = lane(y[k], i);
      for (const ContactIndex c : indices_of(m_.contacts)) {
        const ContactState<Real>& s = w.contacts[c];
        *row++ = lane(s.elastic, i) > 0.0 ? lane(s.approach, i) : kNoApproach;
      }
    }
  }

  const Mechanism& m_;
  const Parameters<Real>& p_;
  const LaneCase* cases_;
  int count_;
  long stride_, next_;          // steps between even looks, step of the next
  std::vector<Real> heaviest_;  // by joint with friction, then two a contact, then by spring
  IndexedVector<BristleIndex, Real> inverse_bound_;
  Real rate_ = Real(0.0), rate_time_ = Real(0.0);
};

}  // namespace linkstudy
