// One run of a pack of cases: constant steps of the classical Runge-Kutta method, observers at
// every accepted state, and a typed cause at the end of each lane. A lane that has ended, or has no
// case, is set back to its start after every step: nothing grows there, and nothing of it is kept.
// M is Mechanism, or a type with the structure in it (core/base/walk.h).
#pragma once

#include "core/base/flush_denormals.h"
#include "core/closures/projection.h"
#include "core/dynamics/equations_of_motion.h"
#include "core/forces/contact_memory.h"
#include "core/numerics/runge_kutta.h"
#include "core/simulation/lane_observers.h"
#include "core/simulation/pack_parameters.h"

namespace linkstudy {

// Beyond these a run is no longer a motion: it has diverged, or its energy has left the ledger.
inline constexpr double kFastest = 1e9;       // rad/s or m/s
inline constexpr double kEnergyFactor = 1e3;  // times the energy that entered, plus
inline constexpr double kEnergyFloor = 1e-3;  // J/kg of the whole linkage
inline constexpr long kStepsBetweenPolls = 256;

template <class Real, class M>
class Run {
 public:
  static constexpr int lanes = RealTraits<Real>::lanes;

  Run(const M& m, const KernelRun& setting, const LaneCase* cases, int count)
      : m_(m),
        setting_(setting),
        cases_(cases),
        count_(count),
        active_((1u << count) - 1u),
        p_(pack_parameters<Real>(cases, count)),
        size_(m.nq + m.nv + m.nz + 2),
        observers_(cases, count),
        w_(make_workspace<Real>(m)),
        rk_(static_cast<std::size_t>(size_)),
        now_(m_, p_, w_) {
    if constexpr (!FixedStructure<M>) {
      y_.resize(static_cast<std::size_t>(size_));
      correction_.resize(static_cast<std::size_t>(m.nv));
      contact_steps_.resize(m.contacts.size());
    }
    for (int i = 0; i < lanes; ++i) reset(i);
    for_bodies(m_, [&](auto b) { mass_ = mass_ + at(p_.bodies, b).mass; });
  }

  void run() {
    const FlushDenormals flush;
    for (step_ = 0;; ++step_) {
      const double t = time();
      differentiate_kept(t);
      now_.move_to(t, y_.data());
      if (step_ == 0) start_ledger();
      check_state();
      if (step_ % setting_.energy_stride == 0) check_energy();
      if (active_ == 0) return;
      observers_.observe(step_, now_);
      if (step_ == setting_.count) break;
      if (step_ % kStepsBetweenPolls == 0 && interrupted(t)) return;
      if (contact_count(m_) > 0) {
        update_contact_memory(m_, w_, contact_steps_.data(), bristles(), contact_log_);
      }
      rk_.advance(t, setting_.h, y_.data(),
                  [this](double s, const Real* y, Real* slope) { differentiate(s, y, slope); });
      finish_step();
      if (active_ != kAllLanes<Real>) reset_idle_lanes();
    }
    end_lanes(active_, Cause::ok);
  }

 private:
  double time() const { return setting_.t0 + static_cast<double>(step_) * setting_.h; }

  template <class W>
  void write_slopes(const Real* q, const Real* v, const W& w, Real* slope) const {
    for_all_stages(m_, [&](auto i) {
      const Stage& s = at(m_.stages, i);
      position_rates(s, q + s.q, v + s.v, slope + s.q);
    });
    Real* rest = slope + m_.nq;
    for_velocities(m_, [&](auto k) { rest[k] = at(w.qdd, k); });
    for_range(Index<0>(), bristle_count(m_), [&](auto i) { rest[m_.nv + i] = at(w.z_rate, i); });
    rest[m_.nv + m_.nz] = w.supplied_power;
    rest[m_.nv + m_.nz + 1] = w.dissipated_power;
  }

  template <class W>
  void evaluate_into(W& w, double t, const Real* q, Real* slope) {
    const Real* v = q + m_.nq;
    for_range(Index<0>(), bristle_count(m_), [&](auto i) { at(w.z, i) = v[m_.nv + i]; });
    evaluate(m_, p_, t, q, v, w);
    write_slopes(q, v, w, slope);
    redundant_ |= w.redundant;
  }

  // Leaves everything in the workspace for observers.
  [[gnu::noinline, gnu::flatten]] void differentiate_kept(double t) {
    evaluate_into(w_, t, y_.data(), rk_.first_slope());
  }

  // A workspace of its own lives in registers as far as they go where the structure is fixed.
  [[gnu::noinline, gnu::flatten]] void differentiate(double t, const Real* q, Real* slope) {
    if constexpr (FixedStructure<M>) {
      Workspace<Real, M> w = make_workspace<Real>(m_);
      w.memory = w_.memory;
      evaluate_into(w, t, q, slope);
    } else {
      evaluate_into(w_, t, q, slope);
    }
  }

  [[gnu::flatten]] void finish_step() {
    if (!m_.ball_q.empty()) normalize_quaternions(m_, y_.data());
    if (!m_.projects) return;
    update_factored_mass_matrix(m_, p_, 0.0, y_.data(), y_.data() + m_.nq, w_);
    project(m_, p_, y_.data(), y_.data() + m_.nq, correction_.data(), w_);
    redundant_ |= w_.redundant;
  }

  void start_ledger() {
    const Energy<Real> e = now_.energy();
    initial_ = e;
    initial_supplied_ = now_.supplied();
    now_.set_initial_energy(e.kinetic + e.potential() - now_.supplied() + now_.dissipated());
  }

  void check_state() {
    Real fastest(0.0), sum(0.0), square(0.0);
    for_velocities(m_, [&](auto k) {
      fastest = max(fastest, abs(at(y_, m_.nq + k)));
      sum = sum + (abs(at(y_, m_.nq + k)) + abs(at(w_.qdd, k)));
    });
    for_range(Index<0>(), bristle_count(m_),
              [&](auto i) { sum = sum + abs(at(y_, m_.nq + m_.nv + i)); });
    for_range(Index<0>(), cut_row_count(m_),
              [&](auto r) { square = madd(at(w_.cut_rows, r).d, at(w_.cut_rows, r).d, square); });
    // A lost velocity is not a number, which is not below anything.
    const auto moving = fastest < Real(kFastest) && is_finite(sum);
    const Real drift = sqrt(square);
    drift_max_ = select(drift > drift_max_, drift, drift_max_);
    const auto closed = drift <= Real(setting_.drift_limit);
    least_rank_ = select(moving && w_.kept_rows < least_rank_, w_.kept_rows, least_rank_);
    greatest_rank_ = select(moving && w_.kept_rows > greatest_rank_, w_.kept_rows, greatest_rank_);
    if constexpr (FixedStructure<M>) abandon_lanes(active_ & redundant_);
    end_lanes(active_ & ~lane_bits(moving), Cause::diverged);
    end_lanes(active_ & ~lane_bits(closed), Cause::constraint_drift);
    end_lanes(active_ & w_.jammed, Cause::diverged);
  }

  // The ledger must hold up to the energy that has entered: work, start, and the swing of weights.
  void check_energy() {
    const Energy<Real> e = now_.energy();
    const Real residual = abs(now_.residual());
    const Real supplied = abs(now_.supplied() - initial_supplied_);
    residual_max_ = select(residual > residual_max_, residual, residual_max_);
    for (const Real& x : {e.kinetic, supplied + abs(now_.dissipated())}) {
      scale_ = select(x > scale_, x, scale_);
    }
    const Real entered =
        supplied + initial_.kinetic + initial_.elastic + abs(e.height - initial_.height);
    const Real limit = madd(Real(kEnergyFactor), entered, Real(kEnergyFloor) * mass_);
    end_lanes(active_ & ~lane_bits(residual <= limit), Cause::energy_blowup);
  }

  bool interrupted(double t) {
    const Cause cause = setting_.poll(setting_.context, t);
    if (cause == Cause::ok) return false;
    end_lanes(active_, cause);
    return true;
  }

  void end_lanes(unsigned ending, Cause cause) {
    for (int i = 0; ending != 0; ++i, ending >>= 1) {
      if ((ending & 1u) != 0) end_lane(i, cause);
    }
  }

  void abandon_lanes(unsigned ending) {
    for (int i = 0; i < count_; ++i) {
      if ((ending >> i & 1u) != 0) cases_[i].end->abandoned = true;
    }
    end_lanes(ending, Cause::ok);
  }

  void end_lane(int i, Cause cause) {
    LaneEnd& end = *cases_[i].end;
    end.cause = cause;
    end.least_rank = static_cast<int>(lane(least_rank_, i));
    end.greatest_rank = static_cast<int>(lane(greatest_rank_, i));
    end.redundant = end.least_rank < cut_row_count(m_);
    end.steps = step_;
    end.drift_max = lane(drift_max_, i);
    end.energy_residual_max = lane(residual_max_, i);
    end.energy_scale = lane(scale_, i);
    end.contacts = lane(contact_log_.begun, i);
    end.least_contact_steps = lane(contact_log_.least_steps, i);
    for (int k = 0; k < size_; ++k) cases_[i].final_y[k] = lane(at(y_, k), i);
    observers_.store(i);
    active_ &= ~(1u << i);
    reset(i);
  }

  void reset_idle_lanes() {
    for (int i = 0; i < lanes; ++i) {
      if ((active_ >> i & 1u) == 0) reset(i);
    }
  }

  void reset(int i) {
    const LaneCase& c = cases_[i < count_ ? i : count_ - 1];
    for (int k = 0; k < size_; ++k) set_lane(at(y_, k), i, c.y[k]);
    for_all_contacts(m_, [&](auto n) { set_contact(n, i, fresh_contact<double>()); });
  }

  void set_contact(int contact, int i, const ContactMemory<double>& from) {
    ContactMemory<Real>& memory = at(w_.memory, contact);
    set_lane(memory.depth, i, from.depth);
    set_lane(memory.rate, i, from.rate);
    set_lane(memory.touching, i, from.touching);
    set_lane(memory.approach, i, from.approach);
    set_lane(memory.least_depth, i, from.least_depth);
    set_lane(at(contact_steps_, contact), i, 0.0);
  }

  Real* bristles() { return y_.data() + m_.nq + m_.nv; }

  using N = Counts<M>;
  const M& m_;
  const KernelRun& setting_;
  const LaneCase* cases_;
  int count_;
  unsigned active_;         // lanes still running, one bit each
  unsigned redundant_ = 0;  // lanes whose rows were dependent or nearly
  Real least_rank_ = Real(1e9), greatest_rank_ = Real(-1.0);  // independent rows seen
  long step_ = 0;
  Parameters<Real> p_;
  int size_;
  Array<Real, N::size> y_;  // q (nq), v (nv), z (nz), supplied, dissipated
  Array<Real, N::nv> correction_;
  Array<Real, N::contacts> contact_steps_;  // states in the present contact
  ContactLog<Real> contact_log_;
  LaneObservers<Real> observers_;
  Workspace<Real, M> w_;
  RungeKutta<ClassicalRungeKutta, Real, N::size> rk_;
  Instant<Real, M> now_;
  Energy<Real> initial_{};
  Real initial_supplied_ = Real(0.0);
  Real mass_ = Real(0.0);
  Real drift_max_ = Real(0.0);
  Real residual_max_ = Real(0.0);
  Real scale_ = Real(0.0);
};

}  // namespace linkstudy
