#include "core/simulation/located_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/flush_denormals.h"
#include "core/simulation/contact_list.h"
#include "core/simulation/contact_nearness.h"
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

// The ledger of an instant, as lanes give it.
struct SeenLedger {
  Energy<double> seen;
  double in, out, initial;

  const Energy<double>& energy() const { return seen; }
  double supplied() const { return in; }
  double dissipated() const { return out; }
  double residual() const { return seen.kinetic + seen.potential() - initial - in + out; }
};

std::unique_ptr<AdaptiveIntegrator> make_integrator(AdaptiveProblem problem, bool is_explicit) {
  if (is_explicit) return std::make_unique<DormandPrince>(std::move(problem));
  return make_adaptive_integrator(AdaptiveMethod::radau, std::move(problem));
}

}  // namespace

LocatedRun::LocatedRun(const Mechanism& m, const SimulationOptions& options,
                       const KernelRun& setting, const LaneCase& c, TrialFrame* frame, int lane)
    : m_(m),
      options_(options),
      setting_(setting),
      case_(c),
      frame_(frame),
      lane_(lane),
      p_(*c.parameters),
      size_(static_cast<std::size_t>(state_size(m))),
      y_(c.y, c.y + size_),
      at_(size_),
      imposed_(m.motions.empty() ? 0 : size_),
      correction_(static_cast<std::size_t>(m.nv)),
      slopes_(size_),
      w_(make_workspace<double>(m)),
      look_w_(make_workspace<double>(m)),
      now_(m_, p_, w_),
      checks_(m_, p_),
      corners_(m_, p_),
      observers_(&case_, 1),
      integrator_(make_integrator(problem(), frame != nullptr)),
      events_([this](double t, Nearness* contacts) { look_inside(t, contacts); },
              static_cast<int>(m.contacts.size())),
      phases_(m.contacts.size()),
      touches_(m.contacts.size()),
      begin_(m.contacts.size()),
      end_(m.contacts.size()),
      quarters_(frame != nullptr ? 3 * m.contacts.size() : 0),
      before_(m.contacts.size()),
      after_(m.contacts.size()),
      samples_(frame != nullptr ? frame->observed().all().size() : 0) {
  if (frame == nullptr) return;
  explicit_ = static_cast<DormandPrince*>(integrator_.get());
  frame_->set_case(lane, c);
  frame_->put(lane, TrialSlots::absolute, options.absolute_tolerance);
  frame_->put(lane, TrialSlots::relative, options.relative_tolerance);
}

AdaptiveProblem LocatedRun::problem() {
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

void LocatedRun::evaluate_at(double t, const double* y) {
  evaluate_state(m_, p_, t, y, w_);
}

void LocatedRun::impose(double t, double* y) const {
  impose_motions(m_, p_, t, y, y + m_.nq);
}

// The integrator's own state may be off the laws by what it allows.
const double* LocatedRun::with_motions(double t, const double* y) {
  if (imposed_.empty()) return y;
  imposed_.assign(y, y + size_);
  impose(t, imposed_.data());
  return imposed_.data();
}

// A step sees courses as they are before the corner where it ends.
void LocatedRun::differentiate(double t, const double* y, double* slope) {
  t = std::min(t, CourseCorners::before(corner_));
  y = with_motions(t, y);
  evaluate_at(t, y);
  write_slopes(m_, y, w_, slope);
  poll(t, 1);
}

// Of differentiate(), (n, n) with n - 2 the numbers of q, v and z; what it imposes does not vary.
bool LocatedRun::differentiate_exactly(double t, const double* y, double* columns) {
  if (!derivative_) derivative_.emplace(m_, p_);
  t = std::min(t, CourseCorners::before(corner_));
  y = with_motions(t, y);
  const double* v = y + m_.nq;
  if (!derivative_->update(t, y, v, v + m_.nv, w_.memory)) return false;
  const Eigen::Index n = derivative_->matrix().rows();
  Eigen::Map<Eigen::MatrixXd> all(columns, n, n);
  all.leftCols(n - 2) = derivative_->matrix();
  all.rightCols(2).setZero();
  for (const MotionStructure& motion : m_.motions) {
    for (const int k : {motion.q.value(), m_.nq + motion.v.value()}) {
      all.row(k).setZero();
      all.col(k).setZero();
    }
  }
  return true;
}

void LocatedRun::poll(double t, long evaluations) {
  since_poll_ += evaluations;
  if (since_poll_ < kStepsBetweenPolls) return;
  since_poll_ = 0;
  const Cause cause = setting_.poll(setting_.context, t);
  if (cause != Cause::ok) fail(cause);
}

void LocatedRun::fail(Cause cause) {
  if (!cause_) cause_ = cause;
}

// Positions and rates only.
void LocatedRun::look_at(const double* y, Nearness* contacts) {
  ++looks_;
  for_nearness(m_, p_, y, look_w_, [contacts](ContactIndex i, double depth, double rate) {
    contacts[i.value()] = {depth, rate};
  });
}

// The solution of the last step.
void LocatedRun::value_at(double t, double* y) {
  if (explicit_ != nullptr && !knows_inside_) {
    DormandPrinceStep<double>& trial = explicit_->trial();
    const TrialSlots& slots = frame_->slots();
    const int n = static_cast<int>(size_);
    frame_->get(lane_, slots.y, n, trial.begin());
    for (int k = 0; k < DormandPrinceStep<double>::powers; ++k) {
      frame_->get(lane_, slots.inside + k * n, n, trial.inside(k));
    }
    knows_inside_ = true;
  }
  integrator_->value_at(t, y);
}

void LocatedRun::look_inside(double t, Nearness* contacts) {
  value_at(t, at_.data());
  impose(t, at_.data());
  if (!m_.ball_q.empty()) normalize_quaternions(m_, at_.data());
  look_at(at_.data(), contacts);
}

void LocatedRun::settle(double t, double* y) {
  settle_state(m_, p_, t, y, correction_.data(), w_);
}

void LocatedRun::begin() {
  look_at(y_.data(), begin_.data());
  for (const ContactIndex i : indices_of(phases_)) {
    phases_[i] = {begin_[i].depth > 0.0, begin_[i].depth == 0.0};
    set_memory(i, begin_[i].rate);
    if (!phases_[i].touching) continue;
    log_.begun += 1.0;
    if (case_.contacts != nullptr) case_.contacts->start_inside(i);
  }
  time_ = setting_.t0;
  observe_grid(0, y_.data());
  if (!cause_) integrator_->start(setting_.t0, y_.data());
  if (frame_ != nullptr) frame_->put(lane_, TrialSlots::initial_energy, now_.initial_energy());
}

void LocatedRun::start() {
  begin();
  if (!has_ended() && begin_step()) ask_for_trial();
}

void LocatedRun::run() {
  begin();
  while (!has_ended()) advance();
}

void LocatedRun::advance() {
  if (integrator_->steps() >= options_.step_limit) return fail(Cause::step_budget);
  const StepResult result = integrator_->step(choose_end());
  if (cause_) return;
  if (result != StepResult::accepted) return fail(Cause::diverged);
  end_step();
}

bool LocatedRun::begin_step() {
  if (integrator_->steps() >= options_.step_limit) {
    fail(Cause::step_budget);
    return false;
  }
  integrator_->begin_step(choose_end());
  return true;
}

void LocatedRun::ask_for_trial() {
  const TrialSlots& slots = frame_->slots();
  const int n = static_cast<int>(size_);
  const double* slopes = explicit_->slopes();
  frame_->put(lane_, TrialSlots::t, explicit_->t());
  frame_->put(lane_, TrialSlots::h, explicit_->trial_length());
  frame_->put(lane_, TrialSlots::last, CourseCorners::before(corner_));
  frame_->put(lane_, slots.memory, TrialSlots::kMemoryNumbers * m_.contact_count(),
              numbers_in<double>(w_.memory));
  frame_->put(lane_, slots.y, n, explicit_->y());
  frame_->put(lane_, slots.slope, n, slopes);
  wants_ = Wants::trial;
}

void LocatedRun::take_trial() {
  const TrialSlots& slots = frame_->slots();
  const int n = static_cast<int>(size_);
  const long evaluations = DormandPrinceStep<double>::evaluations + (is_settled(m_) ? 1 : 0);
  explicit_->count_evaluations(evaluations);
  poll(explicit_->t(), evaluations);
  frame_->get(lane_, slots.end, n, explicit_->trial_end().data());
  frame_->get(lane_, slots.end_slope, n, explicit_->trial().last_slope());
  knows_inside_ = false;
  const auto result = explicit_->end_trial(frame_->get(lane_, slots.error));
  if (cause_) return;
  if (!result) return frame_->put(lane_, TrialSlots::h, explicit_->trial_length());
  if (*result != StepResult::accepted) return fail(Cause::diverged);
  end_step();
}

// Of a step that was accepted.
void LocatedRun::end_step() {
  drift_.reset();
  event_ = find_event();
  reached_ = event_ ? event_->t : integrator_->t();
  go_on();
}

// To the next instant that lanes give, or the next trial.
void LocatedRun::go_on() {
  while (next_instant()) {
    if (is_given_in_lanes()) return ask_for_instant();
    value_at(time_of(step_), at_.data());
    settle(time_of(step_), at_.data());
    observe_grid(step_, at_.data());
    if (cause_) return;
  }
  close_step();
  if (frame_ != nullptr && !has_ended() && begin_step()) ask_for_trial();
}

void LocatedRun::close_step() {
  follow_contacts();
  count_step();
  if (event_) {
    restart_at(*event_);
  } else {
    accept();
  }
  check_drift();
  is_over_ = step_ >= setting_.count;
}

// Where the next step ends at the latest.
double LocatedRun::choose_end() {
  const double t = integrator_->t();
  if (t == corner_) integrator_->replace(y_.data());
  corner_ = corners_.next(t);
  if (!corners_.any_over_coordinates()) return std::min(end_time(), corner_);
  const double* y = integrator_->y();
  const double* a = explicit_ != nullptr ? explicit_->slopes() + m_.nq : w_.qdd.data();
  const double way = corners_.way_ahead(y, y + m_.nq, a);
  const double least = kLeastWay * (end_time() - setting_.t0);
  return std::min({end_time(), corner_, t + std::max(way, least)});
}

// Of the grid, that the step has passed and at which something looks.
bool LocatedRun::next_instant() {
  while (step_ < setting_.count && time_of(step_ + 1) <= reached_) {
    ++step_;
    if (step_ % setting_.energy_stride == 0 || hits(*case_.observers, step_)) return true;
  }
  return false;
}

long LocatedRun::instants_left() const {
  return std::lround(std::ceil((reached_ - time_of(step_)) / setting_.h)) + 1;
}

bool LocatedRun::is_given_in_lanes() const {
  return frame_ != nullptr && !frame_->observed().leaves_out(step_);
}

void LocatedRun::ask_for_instant() {
  const double t = time_of(step_);
  frame_->put(lane_, TrialSlots::instant, t);
  frame_->put(lane_, TrialSlots::part,
              (t - integrator_->t_old()) / (integrator_->t() - integrator_->t_old()));
  wants_ = Wants::instant;
}

void LocatedRun::take_instant() {
  const TrialSlots& slots = frame_->slots();
  const bool is_output = step_ % setting_.energy_stride == 0;
  if (is_output) begun_in_interval_ = 0;
  ++observed_;
  poll(time_of(step_), 1);
  if (!(frame_->get(lane_, slots.moves) > 0.5)) fail(Cause::diverged);
  if (!checks_.is_closed(frame_->get(lane_, slots.instant_drift), setting_.drift_limit)) {
    fail(Cause::constraint_drift);
  }
  checks_.see_rank(true, frame_->get(lane_, slots.rank));
  if (is_output) {
    std::array<double, TrialSlots::kEnergies> e{};
    frame_->get(lane_, slots.energies, TrialSlots::kEnergies, e.data());
    const SeenLedger ledger{{e[0], e[1], e[2]}, e[3], e[4], now_.initial_energy()};
    if (!checks_.balances(ledger)) fail(Cause::energy_blowup);
  }
  if (cause_) return;
  frame_->get(lane_, slots.samples, static_cast<int>(samples_.size()), samples_.data());
  observers_.observe(step_, [this](int observer, std::size_t i, const Channel&) {
    const int first = frame_->observed().first()[static_cast<std::size_t>(observer)];
    return samples_[static_cast<std::size_t>(first) + i];
  });
  go_on();
}

void LocatedRun::observe_grid(long step, const double* y) {
  const double t = time_of(step);
  if (step % setting_.energy_stride == 0) begun_in_interval_ = 0;
  evaluate_at(t, y);
  ++observed_;
  poll(t, 1);
  now_.move_to(t, y);
  if (step == 0) checks_.start_ledger(now_);
  check_motion(y, w_);
  checks_.see_rank(true, w_.kept_rows);
  if (w_.jammed != 0) fail(Cause::diverged);
  if (step % setting_.energy_stride == 0 && !checks_.balances(now_)) fail(Cause::energy_blowup);
  if (!cause_)
    observers_.observe(step, [this](int, std::size_t, const Channel& c) { return now_.sample(c); });
}

void LocatedRun::accept() {
  y_.assign(integrator_->y(), integrator_->y() + size_);
  time_ = integrator_->t();
  if (is_settled(m_)) {
    accept_settled();
  } else {
    impose(time_, y_.data());
    if (frame_ != nullptr) drift_ = frame_->get(lane_, frame_->slots().drift);
  }
  begin_.swap(end_);
  for (const ContactIndex i : indices_of(phases_)) {
    phases_[i].fresh = false;
    if (!phases_[i].touching) continue;
    ContactMemory<double>& memory = w_.memory[i];
    // The force at this state is the same before and after: its law takes the larger speed
    // anyway.
    memory.approach = dividing_speed(approach_of_contact(m_, i), memory.approach, begin_[i].rate);
  }
}

void LocatedRun::accept_settled() {
  if (frame_ == nullptr) {
    settle(time_, y_.data());
    integrator_->replace(y_.data());
    look_at(y_.data(), end_.data());
    return;
  }
  const TrialSlots& slots = frame_->slots();
  const int n = static_cast<int>(size_);
  frame_->get(lane_, slots.settled, n, y_.data());
  frame_->get(lane_, slots.settled_slope, n, slopes_.data());
  read_nearness(slots.settled_near, end_);
  drift_ = frame_->get(lane_, slots.settled_drift);
  explicit_->replace(y_.data(), slopes_.data());
}

// Contacts have been looked at already; cut rows may not have.
void LocatedRun::check_drift() {
  if (!drift_) {
    if (!m_.cut_rows.empty()) {
      update_kinematics(m_, p_, y_.data(), y_.data() + m_.nq, look_w_);
      update_rows<RowStorage::cut>(m_, p_, look_w_);
    }
    drift_ = drift_of(m_, look_w_);
  }
  if (!checks_.moves(m_, y_.data(), look_w_)) fail(Cause::diverged);
  if (!checks_.is_closed(*drift_, setting_.drift_limit)) fail(Cause::constraint_drift);
}

void LocatedRun::check_motion(const double* y, const Workspace<double>& w) {
  if (!checks_.moves(m_, y, w)) fail(Cause::diverged);
  if (!checks_.is_closed(m_, w, setting_.drift_limit)) fail(Cause::constraint_drift);
}

LocatedReport LocatedRun::finish() {
  LaneEnd& end = *case_.end;
  end.cause = cause_.value_or(Cause::ok);
  end.steps = step_;
  end.contacts = log_.begun;
  end.least_contact_steps = log_.least_steps;
  checks_.store(0, m_.cut_row_count(), end);
  std::copy(y_.begin(), y_.end(), case_.final_y);
  observers_.store(0);
  return {time_, integrator_->steps(), integrator_->rejected(),
          integrator_->evaluations() + observed_, looks_};
}

}  // namespace linkstudy
