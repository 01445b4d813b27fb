#include "core/simulation/located_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/motion_derivative.h"
#include "core/numerics/adaptive_integrator.h"
#include "core/simulation/contact_events.h"
#include "core/simulation/contact_list.h"
#include "core/simulation/course_corners.h"
#include "core/simulation/run.h"

namespace linkstudy {
namespace {

constexpr double kOpen = std::numeric_limits<double>::infinity();
constexpr double kLeastWay = 1e-9;  // of the run: shorter ways to a corner are gone in one step

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
        size_(static_cast<std::size_t>(state_size(m))),
        y_(c.y, c.y + size_),
        at_(size_),
        imposed_(m.motions.empty() ? 0 : size_),
        correction_(static_cast<std::size_t>(m.nv)),
        w_(make_workspace<double>(m)),
        look_w_(make_workspace<double>(m)),
        now_(m_, p_, w_),
        checks_(m_, p_),
        corners_(m_, p_),
        observers_(&case_, 1),
        integrator_(make_adaptive_integrator(options.integrator == Integrator::stiff
                                                 ? AdaptiveMethod::radau
                                                 : AdaptiveMethod::dormand_prince,
                                             problem())),
        events_([this](double t, Nearness* contacts) { look_inside(t, contacts); },
                static_cast<int>(m.contacts.size())),
        phases_(m.contacts.size()),
        touches_(m.contacts.size()),
        begin_(m.contacts.size()),
        end_(m.contacts.size()),
        before_(m.contacts.size()),
        after_(m.contacts.size()) {}

  LocatedReport run() {
    const FlushDenormals flush;
    begin();
    while (!cause_ && step_ < setting_.count) advance();
    return finish(cause_.value_or(Cause::ok));
  }

 private:
  AdaptiveProblem problem() {
    AdaptiveProblem p;
    p.slopes = [this](double t, const double* y, double* dy) { differentiate(t, y, dy); };
    p.relative = options_.relative_tolerance;
    p.absolute.assign(size_, options_.absolute_tolerance);
    p.passive = work_count(m_);
    if (options_.integrator == Integrator::stiff) {
      p.derivative = [this](double t, const double* y, double* columns) {
        return differentiate_exactly(t, y, columns);
      };
    }
    // It is told apart without a say in the steps.
    if (!m_.contacts.empty()) p.absolute.back() = kOpen;
    return p;
  }

  double time_of(long step) const { return setting_.t0 + static_cast<double>(step) * setting_.h; }
  double end_time() const { return time_of(setting_.count); }

  [[gnu::flatten]] void evaluate_at(double t, const double* y) { evaluate_state(m_, p_, t, y, w_); }

  void impose(double t, double* y) const { impose_motions(m_, p_, t, y, y + m_.nq); }

  // The integrator's own state may be off the laws by what it allows.
  const double* with_motions(double t, const double* y) {
    if (imposed_.empty()) return y;
    imposed_.assign(y, y + size_);
    impose(t, imposed_.data());
    return imposed_.data();
  }

  void differentiate(double t, const double* y, double* slope) {
    // A step sees courses as they are before the corner where it ends.
    if (t >= corner_) t = CourseCorners::before(corner_);
    y = with_motions(t, y);
    evaluate_at(t, y);
    write_slopes(m_, y, w_, slope);
    if (++since_poll_ >= kStepsBetweenPolls) poll(t);
  }

  // Of differentiate(), (n, n) with n - 2 the numbers of q, v and z; what it imposes does not vary.
  bool differentiate_exactly(double t, const double* y, double* columns) {
    if (!derivative_) derivative_.emplace(m_, p_);
    if (t >= corner_) t = CourseCorners::before(corner_);
    y = with_motions(t, y);
    const double* v = y + m_.nq;
    if (!derivative_->update(t, y, v, v + m_.nv, w_.memory)) return false;
    const Eigen::Index n = derivative_->matrix().rows();
    Eigen::Map<Eigen::MatrixXd> all(columns, n, n);
    all.leftCols(n - 2) = derivative_->matrix();
    all.rightCols(2).setZero();
    for (const MotionStructure& motion : m_.motions) {
      for (const int k : {motion.q, m_.nq + motion.v}) {
        all.row(k).setZero();
        all.col(k).setZero();
      }
    }
    return true;
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
    for_journals(m_, p_, look_w_, [&](int c, const JournalInBearing<double>& j) {
      for (const int i : contacts_of(at(m_.clearances, c))) {
        const auto k = contact_geometry(j, at(m_.contacts, i), at(p_.clearances, c));
        contacts[i] = {k.depth, k.rate};
      }
    });
    for (const int i : indices_of(m_.stops)) {
      const StopStructure& s = at(m_.stops, i);
      contacts[s.contact] = {stop_depth(s, at(p_.stops, i), y), towards_stop(s, y[m_.nq + s.v])};
    }
  }

  void look_inside(double t, Nearness* contacts) {
    integrator_->value_at(t, at_.data());
    impose(t, at_.data());
    if (!m_.ball_q.empty()) normalize_quaternions(m_, at_.data());
    look_at(at_.data(), contacts);
  }

  void settle(double t, double* y) { settle_state(m_, p_, t, y, correction_.data(), w_); }

  void begin() {
    look_at(y_.data(), begin_.data());
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      phases_[i] = {begin_[i].depth > 0.0, begin_[i].depth == 0.0};
      set_memory(i, begin_[i].rate);
      if (!phases_[i].touching) continue;
      log_.begun += 1.0;
      if (case_.contacts != nullptr) case_.contacts->start_inside(static_cast<int>(i));
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
    const StepResult result = integrator_->step(choose_end());
    if (cause_) return;
    if (result != StepResult::accepted) return fail(Cause::diverged);
    const auto event = find_event();
    const double reached = event ? event->t : integrator_->t();
    observe_until(reached);
    if (cause_) return;
    follow_contacts(reached);
    count_step();
    if (event) {
      restart_at(*event);
    } else {
      accept();
    }
    check_accepted();
  }

  // Where the next step ends at the latest.
  double choose_end() {
    const double t = integrator_->t();
    if (t == corner_) integrator_->replace(y_.data());
    corner_ = corners_.next(t);
    const double* y = integrator_->y();
    const double way = corners_.way_ahead(y, y + m_.nq, w_.qdd.data());
    const double least = kLeastWay * (end_time() - setting_.t0);
    return std::min({end_time(), corner_, t + std::max(way, least)});
  }

  std::optional<ContactEvent> find_event() {
    if (phases_.empty()) return std::nullopt;
    look_at(with_motions(integrator_->t(), integrator_->y()), end_.data());
    return events_.find(integrator_->t_old(), integrator_->t(), begin_, end_, phases_);
  }

  // Instants of the grid that the step has passed.
  void observe_until(double reached) {
    while (!cause_ && step_ < setting_.count && time_of(step_ + 1) <= reached) {
      ++step_;
      if (step_ % setting_.energy_stride != 0 && !hits(*case_.observers, step_)) continue;
      integrator_->value_at(time_of(step_), at_.data());
      settle(time_of(step_), at_.data());
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
    if (step == 0) checks_.start_ledger(now_);
    check_motion(y, w_);
    checks_.see_rank(true, w_.kept_rows);
    if (w_.jammed != 0) fail(Cause::diverged);
    if (step % setting_.energy_stride == 0 && !checks_.balances(now_)) fail(Cause::energy_blowup);
    if (!cause_)
      observers_.observe(step,
                         [this](int, std::size_t, const Channel& c) { return now_.sample(c); });
  }

  // By quarters of the step: a cubic each.
  void follow_contacts(double reached) {
    const bool touches = std::any_of(phases_.begin(), phases_.end(),
                                     [](const ContactPhase& phase) { return phase.touching; });
    if (case_.contacts == nullptr || !touches) return;
    before_ = begin_;
    double t = integrator_->t_old();
    const double quarter = 0.25 * (reached - t);
    for (int part = 1; part <= 4; ++part) {
      const double next = part == 4 ? reached : integrator_->t_old() + part * quarter;
      look_inside(next, after_.data());
      for (std::size_t i = 0; i < phases_.size(); ++i) {
        if (!phases_[i].touching) continue;
        case_.contacts->follow(static_cast<int>(i), {t, next, before_[i], after_[i]},
                               w_.memory[i].approach);
      }
      before_.swap(after_);
      t = next;
    }
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
    impose(time_, y_.data());
    if (m_.projects || !m_.ball_q.empty()) {
      settle(time_, y_.data());
      integrator_->replace(y_.data());
      look_at(y_.data(), end_.data());
    }
    begin_.swap(end_);
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      phases_[i].fresh = false;
      if (!phases_[i].touching) continue;
      ContactMemory<double>& memory = w_.memory[i];
      // The force at this state is the same before and after: its law takes the larger speed
      // anyway.
      memory.approach = dividing_speed(approach_of_contact(m_, static_cast<int>(i)),
                                       memory.approach, begin_[i].rate);
    }
  }

  void restart_at(const ContactEvent& event) {
    const auto i = static_cast<std::size_t>(event.contact);
    integrator_->value_at(event.t, y_.data());
    time_ = event.t;
    settle(time_, y_.data());
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
    log_.begun += 1.0;
    touches_[i].steps = 0.0;
    ContactRecorder* recorder = case_.contacts;
    if (recorder != nullptr) recorder->begin(static_cast<int>(i), time_, begin_[i].rate);
    if (++begun_in_interval_ > kMostContacts) fail(Cause::contact_budget);
  }

  void end_contact(std::size_t i) {
    log_.least_steps = std::min(log_.least_steps, touches_[i].steps);
    ContactRecorder* recorder = case_.contacts;
    if (recorder != nullptr) recorder->end(static_cast<int>(i), time_, -begin_[i].rate);
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

  // Contacts have been looked at already; cut rows have not.
  void check_accepted() {
    if (!m_.cut_rows.empty()) {
      update_kinematics(m_, p_, y_.data(), y_.data() + m_.nq, look_w_);
      update_rows<RowStorage::cut>(m_, p_, look_w_);
    }
    check_motion(y_.data(), look_w_);
  }

  void check_motion(const double* y, const Workspace<double>& w) {
    if (!checks_.moves(m_, y, w)) fail(Cause::diverged);
    if (!checks_.is_closed(m_, w, setting_.drift_limit)) fail(Cause::constraint_drift);
  }

  LocatedReport finish(Cause cause) {
    LaneEnd& end = *case_.end;
    end.cause = cause;
    end.steps = step_;
    end.contacts = log_.begun;
    end.least_contact_steps = log_.least_steps;
    checks_.store(0, m_.cut_row_count(), end);
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
  std::vector<double> y_;        // accepted
  double time_ = 0.0;            // of y_
  std::vector<double> at_;       // the same inside a step
  std::vector<double> imposed_;  // a state with driven coordinates as their laws have them
  std::vector<double> correction_;
  Workspace<double> w_, look_w_;
  Instant<double> now_;
  RunChecks<double> checks_;
  CourseCorners corners_;
  double corner_ = std::numeric_limits<double>::infinity();  // that the step may reach, s
  LaneObservers<double> observers_;
  std::optional<MotionDerivative> derivative_;  // of stiff runs
  std::unique_ptr<AdaptiveIntegrator> integrator_;
  ContactEvents events_;
  std::vector<ContactPhase> phases_;
  std::vector<Touch> touches_;
  std::vector<Nearness> begin_, end_;     // of the step
  std::vector<Nearness> before_, after_;  // of a part of it
  std::optional<Cause> cause_;
  long step_ = 0;  // of the grid
  long since_poll_ = 0, observed_ = 0, looks_ = 0;
  long begun_in_interval_ = 0;
  ContactLog<double> log_;
  double free_step_ = 0.0;
};

}  // namespace

LocatedReport run_located(const Mechanism& m, const SimulationOptions& options,
                          const KernelRun& setting, const LaneCase& c) {
  return LocatedRun(m, options, setting, c).run();
}

}  // namespace linkstudy
