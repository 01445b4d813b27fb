#include "core/simulation/located_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/adaptive_integrator.h"
#include "core/simulation/contact_events.h"
#include "core/simulation/run.h"

namespace linkstudy {
namespace {

constexpr double kOpen = std::numeric_limits<double>::infinity();
constexpr int kPowers = 2;  // supplied, dissipated: nothing depends on them

bool hits(const Observers& all, long step) {
  const auto hit = [step](const auto& o) { return o.sampling.hits(step); };
  return std::any_of(all.series.begin(), all.series.end(), hit) ||
         std::any_of(all.comparisons.begin(), all.comparisons.end(), hit) ||
         std::any_of(all.reductions.begin(), all.reductions.end(), hit);
}

struct Touch {
  double steps = 0.0;       // in the present contact
  double first_step = 0.0;  // the length the last contact began with, s
};

class LocatedRun {
 public:
  LocatedRun(const Mechanism& m, const SimulationOptions& options, const KernelRun& setting,
             const LaneCase& c)
      : m_(m),
        options_(options),
        setting_(setting),
        case_(c),
        p_(*c.parameters),
        size_(static_cast<std::size_t>(m.nq + m.nv + m.nz + kPowers)),
        y_(c.y, c.y + size_),
        at_(size_),
        correction_(static_cast<std::size_t>(m.nv)),
        w_(make_workspace<double>(m)),
        look_w_(make_workspace<double>(m)),
        now_(m_, p_, w_),
        observers_(&case_, 1),
        integrator_(make_adaptive_integrator(options.integrator == Integrator::stiff
                                                 ? AdaptiveMethod::rosenbrock
                                                 : AdaptiveMethod::dormand_prince,
                                             problem())),
        events_([this](double t, Nearness* contacts) { look_inside(t, contacts); },
                static_cast<int>(m.contacts.size())),
        phases_(m.contacts.size()),
        touches_(m.contacts.size()),
        begin_(m.contacts.size()),
        end_(m.contacts.size()) {
    for (const auto& body : p_.bodies) mass_ += body.mass;
  }

  LocatedReport run() {
    const FlushDenormals flush;
    begin();
    while (!cause_ && step_ < setting_.count) advance();
    return finish(cause_.value_or(Cause::ok));
  }

 private:
  AdaptiveProblem problem() {
    AdaptiveProblem p;
    p.slopes = [this](double t, const double* y, double* dy) { write_slopes(t, y, dy); };
    p.relative = options_.relative_tolerance;
    p.absolute.assign(size_, options_.absolute_tolerance);
    p.passive = kPowers;
    return p;
  }

  double time_of(long step) const { return setting_.t0 + static_cast<double>(step) * setting_.h; }
  double end_time() const { return time_of(setting_.count); }

  [[gnu::flatten]] void evaluate_at(double t, const double* y) {
    std::copy(y + m_.nq + m_.nv, y + m_.nq + m_.nv + m_.nz, w_.z.begin());
    evaluate(m_, p_, t, y, y + m_.nq, w_);
  }

  void write_slopes(double t, const double* y, double* dy) {
    evaluate_at(t, y);
    const double* v = y + m_.nq;
    for (const Stage& s : m_.stages) position_rates(s, y + s.q, v + s.v, dy + s.q);
    double* rest = std::copy(w_.qdd.begin(), w_.qdd.end(), dy + m_.nq);
    rest = std::copy(w_.z_rate.begin(), w_.z_rate.end(), rest);
    rest[0] = w_.supplied_power;
    rest[1] = w_.dissipated_power;
    if (++since_poll_ >= kStepsBetweenPolls) poll(t);
  }

  void poll(double t) {
    since_poll_ = 0;
    const Cause cause = setting_.poll(setting_.context, t);
    if (cause != Cause::ok) fail(cause);
  }

  void fail(Cause cause) {
    if (!cause_) cause_ = cause;
  }

  // Positions and rates only.
  [[gnu::flatten]] void look_at(const double* y, Nearness* contacts) {
    ++looks_;
    update_kinematics(m_, p_, y, y + m_.nq, look_w_);
    for (const ClearanceStructure& c : m_.clearances) {
      const ClosureStructure& closure = at(m_.closures, c.closure);
      ClosureState<double>& x = at(look_w_.closures, c.closure);
      const BodyState<double>* bodies = look_w_.bodies.data();
      update_closure_pose(m_, closure, at(p_.closures, c.closure), bodies, x);
      const auto j = journal_in_bearing(c, x, bodies[closure.first], bodies[closure.second]);
      const auto& n = p_.clearances[static_cast<std::size_t>(&c - m_.clearances.data())];
      for (int i = c.contact_begin; i < c.contact_end; ++i) {
        const auto k =
            contact_geometry(j, at(m_.contacts, i).side * n.length, n.radial, n.bearing_radius);
        contacts[i] = {k.depth, k.rate};
      }
    }
  }

  void look_inside(double t, Nearness* contacts) {
    integrator_->value_at(t, at_.data());
    if (!m_.ball_q.empty()) normalize_quaternions(m_, at_.data());
    look_at(at_.data(), contacts);
  }

  // Returns a state to unit quaternions and closed joints.
  void settle(double* y) {
    if (!m_.ball_q.empty()) normalize_quaternions(m_, y);
    if (!m_.projects) return;
    update_factored_mass_matrix(m_, p_, 0.0, y, y + m_.nq, w_);
    project(m_, p_, y, y + m_.nq, correction_.data(), w_);
  }

  void begin() {
    look_at(y_.data(), begin_.data());
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      phases_[i] = {begin_[i].depth > 0.0, begin_[i].depth == 0.0};
      set_memory(i, begin_[i].rate);
      if (phases_[i].touching) ++begun_;
    }
    time_ = setting_.t0;
    observe_grid(0, y_.data());
    if (!cause_) integrator_->start(setting_.t0, y_.data());
  }

  void set_memory(std::size_t i, double rate) {
    const bool touching = phases_[i].touching;
    w_.memory[i] = {begin_[i].depth, rate, touching ? 1.0 : 0.0, touching ? std::fabs(rate) : 0.0,
                    touching ? 0.0 : kOpen};
  }

  void advance() {
    if (integrator_->steps() >= options_.step_limit) return fail(Cause::step_budget);
    const StepResult result = integrator_->step(end_time());
    if (cause_) return;
    if (result != StepResult::accepted) return fail(Cause::diverged);
    const auto event = find_event();
    const double reached = event ? event->t : integrator_->t();
    observe_until(reached);
    if (cause_) return;
    count_step();
    if (event) {
      restart_at(*event);
    } else {
      accept();
    }
    check_accepted();
  }

  std::optional<ContactEvent> find_event() {
    if (phases_.empty()) return std::nullopt;
    look_at(integrator_->y(), end_.data());
    return events_.find(integrator_->t_old(), integrator_->t(), begin_, end_, phases_);
  }

  // Instants of the grid that the step has passed.
  void observe_until(double reached) {
    while (!cause_ && step_ < setting_.count && time_of(step_ + 1) <= reached) {
      ++step_;
      if (step_ % setting_.energy_stride != 0 && !hits(*case_.observers, step_)) continue;
      integrator_->value_at(time_of(step_), at_.data());
      settle(at_.data());
      observe_grid(step_, at_.data());
    }
  }

  void observe_grid(long step, const double* y) {
    const double t = time_of(step);
    if (step % setting_.energy_stride == 0) begun_in_interval_ = 0;
    evaluate_at(t, y);
    ++observed_;
    if (++since_poll_ >= kStepsBetweenPolls) poll(t);
    now_.move_to(t, y);
    if (step == 0) start_ledger();
    check_motion(y, w_);
    least_rank_ = std::min(least_rank_, w_.kept_rows);
    greatest_rank_ = std::max(greatest_rank_, w_.kept_rows);
    if (w_.jammed != 0) fail(Cause::diverged);
    if (step % setting_.energy_stride == 0) check_energy();
    if (!cause_) observers_.observe(step, now_);
  }

  void count_step() {
    const double length = integrator_->t() - integrator_->t_old();
    bool touching = false;
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      if (!phases_[i].touching) continue;
      touching = true;
      touches_[i].steps += 1.0;
      if (phases_[i].fresh) touches_[i].first_step = length;
    }
    if (!touching) free_step_ = length;
  }

  void accept() {
    y_.assign(integrator_->y(), integrator_->y() + size_);
    time_ = integrator_->t();
    if (m_.projects || !m_.ball_q.empty()) {
      settle(y_.data());
      integrator_->replace(y_.data());
      look_at(y_.data(), end_.data());
    }
    begin_.swap(end_);
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      phases_[i].fresh = false;
      ContactMemory<double>& memory = w_.memory[i];
      // The force at this state is the same before and after: it takes the larger speed anyway.
      if (phases_[i].touching)
        memory.approach = std::max(memory.approach, std::fabs(begin_[i].rate));
    }
  }

  void restart_at(const ContactEvent& event) {
    const auto i = static_cast<std::size_t>(event.contact);
    integrator_->value_at(event.t, y_.data());
    time_ = event.t;
    settle(y_.data());
    look_at(y_.data(), begin_.data());
    for (ContactPhase& phase : phases_) phase.fresh &= event.t == integrator_->t_old();
    phases_[i] = {!phases_[i].touching, true};
    set_memory(i, begin_[i].rate);
    if (phases_[i].touching) {
      begin_contact(i);
    } else {
      end_contact(i);
    }
    integrator_->start(event.t, y_.data(), first_step(i));
  }

  void begin_contact(std::size_t i) {
    ++begun_;
    touches_[i].steps = 0.0;
    if (++begun_in_interval_ > kMostContacts) fail(Cause::contact_budget);
  }

  void end_contact(std::size_t i) {
    least_steps_ = std::min(least_steps_, touches_[i].steps);
    const ContactStructure& contact = m_.contacts[i];
    const bool resets =
        contact.z >= 0 && at(m_.clearances, contact.clearance).free_bristle == FreeBristle::reset;
    if (resets) y_[static_cast<std::size_t>(m_.nq + m_.nv + contact.z)] = 0.0;
  }

  // 0 where the integrator must find it.
  double first_step(std::size_t i) const {
    if (phases_[i].touching) return touches_[i].first_step;
    const bool still = std::any_of(phases_.begin(), phases_.end(),
                                   [](const ContactPhase& p) { return p.touching; });
    return still ? integrator_->next_step() : free_step_;
  }

  void check_accepted() {
    if (phases_.empty() && m_.cut_rows.empty()) {
      check_speed(y_.data());
      return;
    }
    // Contacts have been looked at already; cut rows have not.
    update_kinematics(m_, p_, y_.data(), y_.data() + m_.nq, look_w_);
    update_rows<ClosureModel::cut>(m_, p_, look_w_);
    check_motion(y_.data(), look_w_);
  }

  void check_speed(const double* y) {
    for (int k = 0; k < m_.nv; ++k) {
      if (!(std::fabs(y[m_.nq + k]) < kFastest)) fail(Cause::diverged);
    }
  }

  void check_motion(const double* y, const Workspace<double>& w) {
    check_speed(y);
    for (const double a : w.qdd) {
      if (!std::isfinite(a)) fail(Cause::diverged);
    }
    double square = 0.0;
    for (const auto& row : w.cut_rows) square += row.d * row.d;
    const double drift = std::sqrt(square);
    drift_max_ = std::max(drift_max_, drift);
    if (!(drift <= setting_.drift_limit)) fail(Cause::constraint_drift);
  }

  void start_ledger() {
    initial_ = now_.energy();
    initial_supplied_ = now_.supplied();
    now_.set_initial_energy(initial_.kinetic + initial_.potential() - now_.supplied() +
                            now_.dissipated());
  }

  // As in run.h: the ledger must hold up to the energy that has entered.
  void check_energy() {
    const Energy<double> e = now_.energy();
    const double residual = std::fabs(now_.residual());
    const double supplied = std::fabs(now_.supplied() - initial_supplied_);
    residual_max_ = std::max(residual_max_, residual);
    scale_ = std::max({scale_, e.kinetic, supplied + std::fabs(now_.dissipated())});
    const double entered =
        supplied + initial_.kinetic + initial_.elastic + std::fabs(e.height - initial_.height);
    if (!(residual <= kEnergyFactor * entered + kEnergyFloor * mass_)) fail(Cause::energy_blowup);
  }

  LocatedReport finish(Cause cause) {
    LaneEnd& end = *case_.end;
    end.cause = cause;
    end.least_rank = static_cast<int>(least_rank_);
    end.greatest_rank = static_cast<int>(greatest_rank_);
    end.redundant = end.least_rank < m_.cut_row_count();
    end.steps = step_;
    end.drift_max = drift_max_;
    end.energy_residual_max = residual_max_;
    end.energy_scale = scale_;
    end.contacts = static_cast<double>(begun_);
    end.least_contact_steps = least_steps_;
    std::copy(y_.begin(), y_.end(), case_.final_y);
    observers_.store(0);
    return {time_, integrator_->steps(), integrator_->rejected(),
            integrator_->evaluations() + observed_, looks_};
  }

  const Mechanism& m_;
  const SimulationOptions& options_;
  const KernelRun& setting_;
  const LaneCase case_;
  const Parameters<double>& p_;
  std::size_t size_;
  std::vector<double> y_;   // accepted: q (nq), v (nv), z (nz), supplied, dissipated
  double time_ = 0.0;       // of y_
  std::vector<double> at_;  // the same inside a step
  std::vector<double> correction_;
  Workspace<double> w_, look_w_;
  Instant<double> now_;
  LaneObservers<double> observers_;
  std::unique_ptr<AdaptiveIntegrator> integrator_;
  ContactEvents events_;
  std::vector<ContactPhase> phases_;
  std::vector<Touch> touches_;
  std::vector<Nearness> begin_, end_;  // of the step
  std::optional<Cause> cause_;
  long step_ = 0;  // of the grid
  long since_poll_ = 0, observed_ = 0, looks_ = 0;
  long begun_ = 0, begun_in_interval_ = 0;
  double least_steps_ = kNoContact;
  double free_step_ = 0.0;
  double least_rank_ = 1e9, greatest_rank_ = -1.0;
  Energy<double> initial_{};
  double initial_supplied_ = 0.0, mass_ = 0.0;
  double drift_max_ = 0.0, residual_max_ = 0.0, scale_ = 0.0;
};

}  // namespace

LocatedReport run_located(const Mechanism& m, const SimulationOptions& options,
                          const KernelRun& setting, const LaneCase& c) {
  return LocatedRun(m, options, setting, c).run();
}

}  // namespace linkstudy
