#include "core/simulation/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/closures/projection.h"
#include "core/dynamics/equations_of_motion.h"
#include "core/numerics/runge_kutta.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

// Beyond these a run is no longer a motion: it has diverged, or its energy has left the ledger.
constexpr double kFastest = 1e9;       // rad/s or m/s
constexpr double kEnergyFactor = 1e3;  // times the energy that entered, plus
constexpr double kEnergyFloor = 1.0;   // J
constexpr long kStepsBetweenClockLooks = 256;

template <class Real>
class Run {
 public:
  Run(const Mechanism& m, const Parameters<Real>& p, const State<Real>& start,
      const SimulationOptions& options, Observers<Real>& observers, const RunLimits& limits)
      : m_(m),
        p_(p),
        options_(options),
        observers_(observers),
        limits_(limits),
        grid_(make_step_grid(options)),
        size_(static_cast<std::size_t>(m.nq + m.nv + 2)),
        t0_(start.t),
        y_(size_),
        correction_(static_cast<std::size_t>(m.nv)),
        w_(make_workspace<Real>(m)),
        rk_(size_),
        now_(m_, p_, w_) {
    std::copy(start.q.begin(), start.q.end(), y_.begin());
    std::copy(start.v.begin(), start.v.end(), y_.begin() + m.nq);
    energy_stride_ = std::max(1L, std::lround(options.output_interval / grid_.h));
    reserve(observers_);
  }

  SimulationOutcome run() {
    const auto begin = Clock::now();
    long step = 0;
    for (;; ++step) {
      const double t = t0_ + static_cast<double>(step) * grid_.h;
      differentiate(t, y_.data(), rk_.first_slope());
      now_.move_to(t, y_.data());
      if (step == 0) start_ledger();
      if (!accept(step, t)) break;
      observe(observers_, step, now_);
      if (step == grid_.count) break;
      if (step % kStepsBetweenClockLooks == 0 && interrupted(begin, t)) break;
      rk_.advance(t, grid_.h, y_.data(),
                  [this](double s, const Real* y, Real* slope) { differentiate(s, y, slope); });
      finish_step();
    }
    outcome_.steps = step;
    outcome_.end_time = t0_ + static_cast<double>(step) * grid_.h;
    store_final_state();
    return std::move(outcome_);
  }

 private:
  void differentiate(double t, const Real* y, Real* slope) {
    const Real* q = y;
    const Real* v = y + m_.nq;
    evaluate(m_, p_, t, q, v, w_);
    for (const Stage& s : m_.stages) position_rates(s, q + s.q, v + s.v, slope + s.q);
    Real* rest = slope + m_.nq;
    for (std::size_t k = 0; k < w_.qdd.size(); ++k) rest[k] = w_.qdd[k];
    rest[m_.nv] = w_.supplied_power;
    rest[m_.nv + 1] = w_.dissipated_power;
  }

  void finish_step() {
    if (!m_.ball_q.empty()) normalize_quaternions(m_, y_.data());
    if (!m_.projects) return;
    update_factored_mass_matrix(m_, p_, 0.0, y_.data(), y_.data() + m_.nq, w_);
    project(m_, p_, y_.data(), y_.data() + m_.nq, correction_.data(), w_);
  }

  void start_ledger() {
    const Energy<Real> e = now_.energy();
    initial_energy_ = e.kinetic + e.potential;
    now_.set_initial_energy(initial_energy_);
    first_kinetic_ = e.kinetic;
  }

  bool accept(long step, double t) {
    Real size(0.0);
    for (int i = 0; i < m_.nv; ++i) size = max(size, abs(y_[static_cast<std::size_t>(m_.nq + i)]));
    Real sum(0.0);
    for (std::size_t i = 0; i < w_.qdd.size(); ++i) sum = sum + abs(w_.qdd[i]);
    if (!(size < kFastest) || !is_finite(sum)) {
      return fail(Cause::diverged, "diverged", t);
    }
    return check_drift(t) && (step % energy_stride_ != 0 || check_energy(t));
  }

  bool check_drift(double t) {
    Real square(0.0);
    for (const RowState<Real>& r : w_.cut_rows) square = madd(r.d, r.d, square);
    const Real drift = sqrt(square);
    outcome_.drift_max = std::max(outcome_.drift_max, drift);
    outcome_.redundant = outcome_.redundant || w_.redundant;
    if (drift <= options_.drift_limit) return true;
    return fail(Cause::constraint_drift, "cut joints opened beyond simulation.drift_limit", t);
  }

  bool check_energy(double t) {
    const Energy<Real> e = now_.energy();
    const Real residual = abs(now_.residual());
    const Real work = abs(now_.supplied()) + abs(now_.dissipated());
    outcome_.energy_residual_max = std::max(outcome_.energy_residual_max, residual);
    outcome_.energy_scale = std::max({outcome_.energy_scale, e.kinetic, work});
    const Real swing = abs(e.potential - (initial_energy_ - first_kinetic_));
    const Real entered = abs(now_.supplied()) + first_kinetic_ + swing;
    if (residual <= madd(Real(kEnergyFactor), entered, Real(kEnergyFloor))) return true;
    return fail(Cause::energy_blowup, "energy left the ledger", t);
  }

  bool interrupted(Clock::time_point begin, double t) {
    if (limits_.reached) limits_.reached->store(t, std::memory_order_relaxed);
    if (limits_.cancelled && limits_.cancelled->load(std::memory_order_relaxed)) {
      outcome_.cause = Cause::cancelled;
      outcome_.message = "cancelled";
      return true;
    }
    const std::chrono::duration<double> spent = Clock::now() - begin;
    if (limits_.timeout_s <= 0.0 || spent.count() < limits_.timeout_s) return false;
    outcome_.cause = Cause::timeout;
    outcome_.message = "wall time of the run used up";
    return true;
  }

  bool fail(Cause cause, const char* what, double t) {
    outcome_.cause = cause;
    outcome_.message = std::string(what) + " at t = " + std::to_string(t) + " s";
    return false;
  }

  void store_final_state() {
    State<double>& s = outcome_.final_state;
    s.t = outcome_.end_time;
    s.q.assign(y_.begin(), y_.begin() + m_.nq);
    s.v.assign(y_.begin() + m_.nq, y_.begin() + m_.nq + m_.nv);
    s.supplied = y_[size_ - 2];
    s.dissipated = y_[size_ - 1];
  }

  const Mechanism& m_;
  const Parameters<Real>& p_;
  const SimulationOptions& options_;
  Observers<Real>& observers_;
  const RunLimits& limits_;
  StepGrid grid_;
  std::size_t size_;
  double t0_;
  std::vector<Real> y_;  // q (nq), v (nv), supplied, dissipated
  std::vector<Real> correction_;
  Workspace<Real> w_;
  RungeKutta<ClassicalRungeKutta, Real> rk_;
  Instant<Real> now_;
  SimulationOutcome outcome_;
  Real initial_energy_ = Real(0.0);
  Real first_kinetic_ = Real(0.0);
  long energy_stride_ = 1;
};

}  // namespace

StepGrid make_step_grid(const SimulationOptions& options) {
  const double ratio = options.end_time / options.step;
  const long count = std::max(1L, static_cast<long>(std::ceil(ratio * (1.0 - 1e-12))));
  return {count, options.end_time / static_cast<double>(count)};
}

SimulationOutcome simulate(const Mechanism& mechanism, const Parameters<double>& parameters,
                           const State<double>& start, const SimulationOptions& options,
                           Observers<double>& observers, const RunLimits& limits) {
  return Run<double>(mechanism, parameters, start, options, observers, limits).run();
}

}  // namespace linkstudy
