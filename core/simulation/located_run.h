// One run by an adaptive integrator, with the begin and the end of every contact located. Observers
// see the instants of the step grid, t0 + k h, by the dense output of the integrator and an
// evaluation of the equations of motion there; only those that some observer or the energy ledger
// asks for.
//
// Trials of explicit steps, and instants inside them where those look who often do, are made beside
// those of other runs, in a lane of a frame (core/simulation/trial_frame.h); all else is this run's
// alone, as is all of an implicit one.
//
// Between two events each contact keeps to its phase: one that is open has no force even where
// rounding puts it inside, one that touches has the approach speed of its beginning, raised where
// it is driven faster later if ApproachSpeed::greatest is asked for. At an event the integrator
// starts anew: in contact with the first step that the last contact began with, out of contact with
// the steps from before it. Bristles that start afresh are set to zero when their contact ends.
//
// More than kMostContacts contacts begun within one output interval end the run (contact_budget):
// bounces whose times have a limit would otherwise never reach it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/dynamics/motion_derivative.h"
#include "core/numerics/dormand_prince_integrator.h"
#include "core/simulation/contact_events.h"
#include "core/simulation/course_corners.h"
#include "core/simulation/lane_observers.h"
#include "core/simulation/options.h"
#include "core/simulation/run_checks.h"
#include "core/simulation/trial_frame.h"

namespace linkstudy {

inline constexpr long kMostContacts = 20'000;

struct LocatedReport {
  double end_time = 0.0;  // reached, s
  long steps = 0;         // accepted
  long rejected = 0;
  long evaluations = 0;  // of the equations of motion, those for observers included
  long looks = 0;        // at positions and rates only, for contacts and drift
};

class LocatedRun {
 public:
  enum class Wants { trial, instant };

  // frame: of explicit runs, with the case in its lane. All must outlive it.
  LocatedRun(const Mechanism& m, const SimulationOptions& options, const KernelRun& setting,
             const LaneCase& c, TrialFrame* frame = nullptr, int lane = 0);
  LocatedRun(const LocatedRun&) = delete;
  LocatedRun& operator=(const LocatedRun&) = delete;

  // Of an explicit run: the first trial is asked for, or it has ended.
  void start();
  // Goes on from what it has asked for, to what it asks for next or to the end.
  void take_trial();
  void take_instant();
  Wants wants() const { return wants_; }
  // At most, before the next trial.
  long instants_left() const;
  bool has_ended() const { return cause_ || is_over_; }

  // The whole of an implicit one.
  void run();

  // Fills the end of the case (`steps`: instants of the grid reached), its final state and its
  // observers.
  LocatedReport finish();

 private:
  struct Touch {
    double steps = 0.0;       // in the present contact
    double first_step = 0.0;  // the length the last contact began with, s
  };

  AdaptiveProblem problem();
  double time_of(long step) const { return setting_.t0 + static_cast<double>(step) * setting_.h; }
  double end_time() const { return time_of(setting_.count); }
  void fail(Cause cause);
  void poll(double t, long evaluations);

  void evaluate_at(double t, const double* y);
  void impose(double t, double* y) const;
  const double* with_motions(double t, const double* y);
  void differentiate(double t, const double* y, double* slope);
  bool differentiate_exactly(double t, const double* y, double* columns);
  void settle(double t, double* y);
  void value_at(double t, double* y);
  void look_at(const double* y, Nearness* contacts);
  void look_inside(double t, Nearness* contacts);

  void begin();
  bool begin_step();
  double choose_end();
  void ask_for_trial();
  void read_nearness(int slot, std::vector<Nearness>& contacts) const;
  void advance();
  void end_step();
  void go_on();
  void close_step();
  std::optional<ContactEvent> find_event();
  bool next_instant();
  bool is_given_in_lanes() const;
  void ask_for_instant();
  void observe_grid(long step, const double* y);
  void follow_contacts();
  void count_step();
  void accept();
  void accept_settled();
  void restart_at(const ContactEvent& event);
  void set_memory(ContactIndex i, double rate);
  void begin_contact(ContactIndex i);
  void end_contact(ContactIndex i);
  double first_step(ContactIndex i) const;
  void check_drift();
  void check_motion(const double* y, const Workspace<double>& w);

  const Mechanism& m_;
  const SimulationOptions& options_;
  const KernelRun setting_;
  const LaneCase case_;
  TrialFrame* frame_;  // or none
  int lane_;
  const Parameters<double>& p_;
  std::size_t size_;
  std::vector<double> y_;        // accepted
  double time_ = 0.0;            // of y_
  std::vector<double> at_;       // the same inside a step
  std::vector<double> imposed_;  // a state with driven coordinates as their laws have them
  std::vector<double> correction_, slopes_;
  Workspace<double> w_, look_w_;
  Instant<double> now_;
  RunChecks<double> checks_;
  CourseCorners corners_;
  double corner_ = std::numeric_limits<double>::infinity();  // that the step may reach, s
  LaneObservers<double> observers_;
  std::optional<MotionDerivative> derivative_;  // of stiff runs
  std::unique_ptr<AdaptiveIntegrator> integrator_;
  DormandPrince* explicit_ = nullptr;  // the same, of explicit runs
  bool knows_inside_ = false;          // what the trial says between its ends has been read
  ContactEvents events_;
  IndexedVector<ContactIndex, ContactPhase> phases_;
  IndexedVector<ContactIndex, Touch> touches_;
  IndexedVector<ContactIndex, Nearness> begin_, end_;  // of the step
  std::vector<Nearness> quarters_;  // of explicit steps, three times all contacts
  IndexedVector<ContactIndex, Nearness> before_, after_;  // of a part of it
  std::optional<ContactEvent> event_;                     // in the step
  double reached_ = 0.0;                                  // the time it is followed to
  std::optional<double> drift_;                           // at y_, where it is known
  std::vector<double> samples_;                           // of channels that lanes give
  Wants wants_ = Wants::trial;
  std::optional<Cause> cause_;
  bool is_over_ = false;
  long step_ = 0;  // of the grid
  long since_poll_ = 0, observed_ = 0, looks_ = 0;
  long begun_in_interval_ = 0;
  ContactLog<double> log_;
  double free_step_ = 0.0;
};

}  // namespace linkstudy
