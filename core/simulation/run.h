// One run of a pack of cases: constant steps of the classical Runge-Kutta method, observers at
// every accepted state, and a typed cause at the end of each lane. A lane that has ended, or has no
// case, is set back to its start after every step: nothing grows there, and nothing of it is kept.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/base/flush_denormals.h"
#include "core/forces/contact_memory.h"
#include "core/numerics/runge_kutta.h"
#include "core/simulation/lane_observers.h"
#include "core/simulation/pack_parameters.h"
#include "core/simulation/run_checks.h"
#include "core/simulation/run_state.h"
#include "core/simulation/step_watch.h"
#include "core/simulation/written_lanes.h"

namespace linkstudy {

inline constexpr long kStepsBetweenPolls = 256;

// Cases of a run, and which it is of the packs that go side by side.
struct RunCases {
  const LaneCase* first;
  int count;
  int pack;
};

template <class Real>
class Run {
 public:
  static constexpr int lanes = RealTraits<Real>::lanes;

  // Members refer to each other: it stays where it is.
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  Run(const Mechanism& m, const KernelRun& setting, const RunCases& cases,
      const SharedCode<Real>& code)
      : m_(m),
        setting_(setting),
        cases_(cases.first),
        count_(cases.count),
        active_((1u << count_) - 1u),
        p_(pack_parameters<Real>(cases_, count_)),
        size_(state_size(m)),
        own_y_(static_cast<std::size_t>(size_)),
        y_(own_y_.data()),
        correction_(static_cast<std::size_t>(m.nv)),
        contact_steps_(m.contacts.size()),
        observers_(cases_, count_),
        w_(make_workspace<Real>(m)),
        rk_(own_y_.size()),
        now_(m_, p_, w_),
        checks_(m_, p_),
        watch_(m_, p_, cases_, count_, setting.count),
        written_(code, cases.pack, setting.h, setting.drift_limit, p_) {
    for (int i = 0; i < lanes; ++i) reset(i);
    move_state();
  }

  // What comes before the written code in a step: looks at the state where something is due, and
  // hands it over. False once all lanes have ended.
  bool begin_step() {
    if (written_.takes_other_code()) move_state();
    is_quiet_ = is_quiet();
    if (!is_quiet_ && !look()) return false;
    asks_ = written_.is_there() && step_ > 0;
    if (asks_) written_.read(time(), now_.initial_energy(), [this](auto&& f) { for_state(f); });
    return true;
  }

  // Whether the code is to do the step that has begun, and whether all is well with what it did.
  bool asks_code() const { return asks_; }
  bool is_fine() const { return (written_.fine() & active_) == active_; }

  // The rest of the step, by the code or, from the same state, by the general loop. False once all
  // lanes have ended.
  bool end_step(bool by_code) {
    by_code = by_code && (!is_quiet_ || see_step());
    if (is_quiet_ && !by_code && !look()) return false;
    if (by_code) {
      take_next();
    } else {
      advance();
    }
    ++step_;
    return true;
  }

 private:
  // To the frame of the written code, if it can stay there.
  void move_state() {
    Real* const to = written_.state() != nullptr ? written_.state() : own_y_.data();
    if (to != y_) std::copy_n(y_, size_, to);
    y_ = to;
  }

  // The general evaluation of an accepted state, for all who look at it. False once all lanes have
  // ended.
  bool look() {
    const double t = time();
    if (step_ == 0 && m_.contact_count() > 0) {
      differentiate_kept(t);
      begin_contact_memory(m_, w_);
    }
    differentiate_kept(t);
    now_.move_to(Real(t), y_);
    if (step_ == 0) checks_.start_ledger(now_);
    check_state();
    if (step_ % setting_.energy_stride == 0) check_energy();
    if (active_ == 0) return false;
    watch_.see(step_, t, y_, w_, active_);
    record_contacts(t);
    observers_.observe(
        step_, [this](int, std::size_t, const Channel& channel) { return now_.sample(channel); });
    if (step_ == setting_.count) end_lanes(active_, Cause::ok);
    return active_ != 0 && !(step_ % kStepsBetweenPolls == 0 && interrupted(t));
  }

  [[gnu::noinline]] void advance() {
    const double t = time();
    if (m_.contact_count() > 0) {
      update_contact_memory(m_, w_, contact_steps_.data(), bristles(), contact_log_);
    }
    rk_.advance(Real(t), Real(setting_.h), y_,
                [this](Real s, Real* y, Real* slope) { differentiate(s, y, slope); });
    finish_step(Real(t) + Real(setting_.h));
    if (active_ != kAllLanes<Real>) reset_idle_lanes();
  }

  double time() const { return setting_.t0 + static_cast<double>(step_) * setting_.h; }

  void evaluate_into(Workspace<Real>& w, Real t, const Real* y, Real* slope) {
    evaluate_state(m_, p_, t, y, w);
    write_slopes(m_, y, w, slope);
  }

  // Leaves everything in the workspace for observers.
  [[gnu::noinline]] void differentiate_kept(double t) {
    evaluate_into(w_, Real(t), y_, rk_.first_slope());
  }

  [[gnu::noinline]] void differentiate(Real t, Real* y, Real* slope) {
    impose_motions(m_, p_, t, y, y + m_.nq);
    evaluate_into(w_, t, y, slope);
  }

  void finish_step(Real t) { settle_state(m_, p_, t, y_, correction_.data(), w_); }

  // Nothing happens in a step but the step itself, as far as can be said beforehand.
  bool is_quiet() const {
    return written_.is_there() && active_ != 0 && step_ > 0 && step_ < setting_.count &&
           step_ % setting_.energy_stride != 0 && !watch_.looks_at(step_) &&
           !written_.leaves_out(step_);
  }

  // What looks at a step of the code. False, and nothing has changed, where some lane needs the
  // general step.
  [[gnu::noinline]] bool see_step() {
    if (m_.nz > 0 && (lane_bits(watch_.bristles_hold(bristles())) & active_) != active_)
      return false;
    const double t = time();
    written_.write_kept(w_);
    checks_.see_rank(Real(1.0) > Real(0.0), w_.kept_rows);
    watch_.see(step_, t, y_, w_, active_);
    record_contacts(t);
    observers_.observe(step_, [this](int observer, std::size_t i, const Channel&) {
      return written_.observed(observer, i);
    });
    if (step_ % kStepsBetweenPolls == 0) interrupted(t);
    return true;
  }

  // Of an accepted state; what contacts remember is still that of the state before.
  void record_contacts(double t) {
    if (cases_[0].contacts == nullptr) return;
    for (const ContactIndex i : indices_of(m_.contacts)) {
      const ContactMemory<Real>& memory = w_.memory[i];
      const unsigned touches = lane_bits(w_.contacts[i].depth > memory.least_depth);
      const unsigned touched = lane_bits(memory.touching > Real(0.5));
      if (((touches | touched) & active_) != 0) record_contact_of(i, t, touches, touched);
    }
  }

  [[gnu::noinline]] void record_contact_of(ContactIndex contact, double t, unsigned touches,
                                           unsigned touched) {
    const ContactMemory<Real>& before = w_.memory[contact];
    const ContactState<Real>& now = w_.contacts[contact];
    for (int i = 0; i < count_; ++i) {
      if (((touches | touched) & active_) >> i & 1u) {
        record_contact(*cases_[i].contacts,
                       {contact, step_ > 0 ? t - setting_.h : t, t, lane(before.depth, i),
                        lane(before.rate, i), lane(now.depth, i), lane(now.rate, i),
                        lane(now.approach, i), (touched >> i & 1u) != 0, (touches >> i & 1u) != 0});
      }
    }
  }

  void take_next() {
    written_.write_next([this](auto&& f) { for_state(f); });
    if (active_ != kAllLanes<Real>) reset_idle_lanes();
  }

  template <class F>
  void for_state(F&& f) {
    const std::span<Real> y(y_, static_cast<std::size_t>(size_));
    for_state_numbers<Real>(y, w_.memory, contact_steps_, contact_log_, checks_.drift_max(), f);
  }

  void check_state() {
    const auto moving = checks_.moves(m_, y_, w_);
    const auto closed = checks_.is_closed(m_, w_, Real(setting_.drift_limit));
    checks_.see_rank(moving, w_.kept_rows);
    end_lanes(active_ & ~lane_bits(moving), Cause::diverged);
    end_lanes(active_ & ~lane_bits(closed), Cause::constraint_drift);
    // Bristles bent beyond their law jam joints, too.
    end_lanes(active_ & ~lane_bits(watch_.bristles_hold(bristles())), Cause::step_too_coarse);
    end_lanes(active_ & w_.jammed, Cause::diverged);
  }

  void check_energy() {
    end_lanes(active_ & ~lane_bits(checks_.balances(now_)), Cause::energy_blowup);
  }

  bool interrupted(double t) {
    const Cause cause = setting_.poll(setting_.context, t);
    if (cause == Cause::ok) return false;
    end_lanes(active_, cause);
    return true;
  }

  void end_lanes(unsigned ending, Cause cause) {
    for (int i = 0; ending != 0; ++i, ending >>= 1)
      if ((ending & 1u) != 0) end_lane(i, cause);
  }

  void end_lane(int i, Cause cause) {
    LaneEnd& end = *cases_[i].end;
    end.cause = cause;
    checks_.store(i, m_.cut_row_count(), end);
    watch_.store(i, end);
    end.steps = step_;
    end.contacts = lane(contact_log_.begun, i);
    end.least_contact_steps = lane(contact_log_.least_steps, i);
    for (int k = 0; k < size_; ++k) cases_[i].final_y[k] = lane(y_[k], i);
    observers_.store(i);
    active_ &= ~(1u << i);
    reset(i);
  }

  void reset_idle_lanes() {
    for (int i = 0; i < lanes; ++i)
      if ((active_ >> i & 1u) == 0) reset(i);
  }

  void reset(int i) {
    const LaneCase& c = cases_[i < count_ ? i : count_ - 1];
    for (int k = 0; k < size_; ++k) set_lane(y_[k], i, c.y[k]);
    for (const ContactIndex n : indices_of(m_.contacts)) set_contact(n, i, fresh_contact<double>());
  }

  void set_contact(ContactIndex contact, int i, const ContactMemory<double>& from) {
    ContactMemory<Real>& memory = w_.memory[contact];
    set_lane(memory.depth, i, from.depth);
    set_lane(memory.rate, i, from.rate);
    set_lane(memory.touching, i, from.touching);
    set_lane(memory.approach, i, from.approach);
    set_lane(memory.least_depth, i, from.least_depth);
    set_lane(contact_steps_[contact], i, 0.0);
  }

  Real* bristles() { return y_ + m_.nq + m_.nv; }

  const Mechanism& m_;
  const KernelRun& setting_;
  const LaneCase* cases_;
  int count_;
  unsigned active_;  // lanes still running, one bit each
  long step_ = 0;
  bool is_quiet_ = false, asks_ = false;  // of the step that has begun
  Parameters<Real> p_;
  int size_;
  std::vector<Real> own_y_;
  Real* y_;  // the state (core/simulation/run_state.h), here or in the frame of the written code
  std::vector<Real> correction_;
  IndexedVector<ContactIndex, Real> contact_steps_;  // states in the present contact
  ContactLog<Real> contact_log_;
  LaneObservers<Real> observers_;
  Workspace<Real> w_;
  RungeKutta<ClassicalRungeKutta, Real> rk_;
  Instant<Real> now_;
  RunChecks<Real> checks_;
  StepWatch<Real> watch_;
  WrittenLanes<Real> written_;
};

template <class Real>
void run_alone(Run<Real>& run, SharedCode<Real>& code) {
  const FlushDenormals flush;
  while (run.begin_step()) {
    const bool asks = run.asks_code();
    if (asks) code.run();
    const bool by_code = asks && run.is_fine();
    const bool goes_on = run.end_step(by_code);
    if (asks) code.note(by_code);
    if (!goes_on) return;
  }
}

// Two packs on one frame: the code does a step of both at once. One that has ended goes along.
template <class Real>
void run_beside(Run<Real>& first, Run<Real>& second, SharedCode<Real>& code) {
  const FlushDenormals flush;
  bool is_first = true, is_second = true;
  for (;;) {
    is_first = is_first && first.begin_step();
    is_second = is_second && second.begin_step();
    if (!is_first && !is_second) return;
    const bool first_asks = is_first && first.asks_code();
    const bool second_asks = is_second && second.asks_code();
    if (first_asks || second_asks) code.run();
    const bool first_fine = first_asks && first.is_fine();
    const bool second_fine = second_asks && second.is_fine();
    is_first = is_first && first.end_step(first_fine);
    is_second = is_second && second.end_step(second_fine);
    if (first_asks || second_asks) {
      code.note(first_fine == first_asks && second_fine == second_asks);
    }
  }
}

}  // namespace linkstudy
