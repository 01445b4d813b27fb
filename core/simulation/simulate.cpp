#include "core/simulation/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>

#include "core/kinematics/three_turns.h"
#include "core/simulation/contact_list.h"
#include "core/simulation/kernels.h"
#include "core/simulation/located_batch.h"
#include "core/simulation/looks.h"
#include "core/simulation/pack_code.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kOpenLedger = 1e-2;        // of the energies in it
constexpr double kRoundingOfEnergy = 1e-9;  // J, of a linkage at rest

// What ends a run from outside.
struct Watch {
  const RunLimits& limits;
  Clock::time_point begin = Clock::now();

  static Cause poll(void* context, double t) {
    const Watch& w = *static_cast<const Watch*>(context);
    if (w.limits.reached) w.limits.reached->store(t, std::memory_order_relaxed);
    if (w.limits.cancelled && w.limits.cancelled->load(std::memory_order_relaxed)) {
      return Cause::cancelled;
    }
    const std::chrono::duration<double> spent = Clock::now() - w.begin;
    const bool late = w.limits.timeout_s > 0.0 && spent.count() >= w.limits.timeout_s;
    return late ? Cause::timeout : Cause::ok;
  }
};

std::string describe_end(Cause cause, double t) {
  const std::string at = " at t = " + std::to_string(t) + " s";
  switch (cause) {
    case Cause::diverged:
      return "diverged" + at;
    case Cause::constraint_drift:
      return "cut joints opened beyond simulation.drift_limit" + at;
    case Cause::energy_blowup:
      return "energy left the ledger" + at;
    case Cause::step_budget:
      return "simulation.step_limit used up" + at;
    case Cause::contact_budget:
      return "more than " + std::to_string(kMostContacts) +
             " contacts began within one output interval" + at;
    case Cause::step_too_coarse:
      return "bristles of friction left their law" + at;
    case Cause::timeout:
      return "wall time of the run used up";
    case Cause::cancelled:
      return "cancelled";
    default:
      return "";
  }
}

// Space for everything a run will write.
void size_observers(Observers& all) {
  for (auto& s : all.series) {
    s.values.assign(static_cast<std::size_t>(s.sampling.count()) * s.channels.size(), 0.0);
  }
  for (auto& s : all.comparisons) {
    s.max_error.assign(s.channels.size(), 0.0);
    s.square_error.assign(s.channels.size(), 0.0);
  }
}

// The cases of one pack, and what its kernel reads and writes.
class Packed {
 public:
  Packed(const Mechanism& m, std::span<BatchCase> cases)
      : m_(m),
        cases_(cases),
        ends_(cases.size()),
        samples_(cases.size()),
        looks_(cases.size(), std::vector(static_cast<std::size_t>(look_count(m) * look_size(m)),
                                         std::numeric_limits<double>::quiet_NaN())) {
    for (std::size_t i = 0; i < cases.size(); ++i) add(i);
  }

  std::span<const LaneCase> lanes() const { return lanes_; }

  // `count` cases from `first` on at once, within the limits for themselves.
  void run(const SimulationOptions& options, const RunLimits& limits, const Kernel& kernel,
           const StepCode* code, std::size_t first, std::size_t count) {
    Watch watch{limits};
    KernelRun setting = setting_of(options, watch);
    setting.code = code;
    kernel.run(m_, setting, &lanes_[first], static_cast<int>(count));
    for (std::size_t i = first; i < first + count; ++i) {
      const long steps = ends_[i].steps;
      const double reached = setting.t0 + static_cast<double>(steps) * setting.h;
      store(i, {reached, steps, 0, kStepEvaluations * steps, 0});
      judge_step(i, setting.h);
    }
  }

  // The same with steps of their own and contacts located; each has the time limit for itself.
  void run_adaptive(const SimulationOptions& options, const RunLimits& limits,
                    const SimdLevel& level) {
    std::deque<Watch> watches;
    const auto reports = run_located(m_, options, lanes_, level, [&](std::size_t) {
      return setting_of(options, watches.emplace_back(Watch{limits}));
    });
    for (std::size_t i = 0; i < cases_.size(); ++i) store(i, reports[i]);
  }

 private:
  static constexpr long kStepEvaluations = 4;

  KernelRun setting_of(const SimulationOptions& options, Watch& watch) const {
    const StepGrid grid = make_step_grid(options);
    const long stride = sample_output(grid, options.output_interval).stride;
    return {cases_[0].start->t,  grid.h,      grid.count, stride,
            options.drift_limit, Watch::poll, &watch};
  }

  void add(std::size_t i) {
    const BatchCase& c = cases_[i];
    size_observers(*c.observers);
    samples_[i].assign(c.observers->series.size(), 0);
    auto& y = starts_.emplace_back(c.start->q);
    y.insert(y.end(), c.start->v.begin(), c.start->v.end());
    y.insert(y.end(), c.start->z.begin(), c.start->z.end());
    y.resize(static_cast<std::size_t>(first_work(m_)));
    y.insert(y.end(), {c.start->supplied, c.start->dissipated});
    if (!m_.contacts.empty()) y.push_back(c.start->dissipated_in_contacts);
    auto& final_y = finals_.emplace_back(y.size());
    lanes_.push_back({c.parameters, y.data(), final_y.data(), c.observers, samples_[i].data(),
                      &ends_[i], looks_[i].data(), add_recorder(c)});
  }

  ContactRecorder* add_recorder(const BatchCase& c) {
    ContactList& list = c.observers->contacts;
    list = {list.most, {}, 0, {}};
    if (list.most == 0 || m_.contacts.empty()) return nullptr;
    return &recorders_.emplace_back(m_, *c.parameters, list);
  }

  // What the limit along the run makes of its end.
  void judge_step(std::size_t i, double h) {
    BatchCase& c = cases_[i];
    SimulationOutcome& o = c.outcome;
    o.step_limit = find_step_limit(m_, *c.parameters, looks_[i], !c.known_along, ends_[i], c.known);
    const bool is_past = h > o.step_limit.seconds;
    const std::string past = is_past ? describe_past_limit(h, o.step_limit) : "";
    if (o.cause == Cause::step_too_coarse) {
      o.message += is_past ? "; " + past : "";
    } else if (o.cause == Cause::ok && is_past && !energy_balances(o)) {
      o.cause = Cause::step_too_coarse;
      o.message = "energy does not balance within 1 %; " + past;
    } else if (o.cause == Cause::ok && is_past && !(h > c.known.seconds)) {
      o.warning = past + "; its energy and friction balance";
    }
  }

  void store(std::size_t i, const LocatedReport& report) {
    const LaneEnd& end = ends_[i];
    SimulationOutcome& o = cases_[i].outcome;
    o = {};
    o.step_limit = cases_[i].known;
    o.cause = end.cause;
    o.steps = report.steps;
    o.rejected = report.rejected;
    o.evaluations = report.evaluations;
    o.end_time = report.end_time;
    o.message = describe_end(end.cause, o.end_time);
    o.drift_max = end.drift_max;
    o.energy_residual_max = end.energy_residual_max;
    o.energy_scale = end.energy_scale;
    o.redundant = end.redundant;
    o.least_rank = end.least_rank;
    o.greatest_rank = end.greatest_rank;
    const auto& y = finals_[i];
    o.final_state.t = o.end_time;
    o.final_state.q.assign(y.begin(), y.begin() + m_.nq);
    o.contacts = static_cast<long>(end.contacts);
    o.least_contact_steps =
        end.least_contact_steps < kNoContact ? static_cast<long>(end.least_contact_steps) : 0;
    const auto v = y.begin() + m_.nq;
    o.final_state.v.assign(v, v + m_.nv);
    o.final_state.z.assign(v + m_.nv, v + m_.nv + m_.nz);
    const auto works = v + m_.nv + m_.nz;
    o.final_state.supplied = works[0];
    o.final_state.dissipated = works[1];
    if (!m_.contacts.empty()) o.final_state.dissipated_in_contacts = works[2];
    o.message += angles_note(o);
    for (std::size_t k = 0; k < samples_[i].size(); ++k) {
      auto& s = cases_[i].observers->series[k];
      s.values.resize(samples_[i][k] * s.channels.size());
    }
  }

  // A run that is lost where the angles of a ball joint fail says so.
  std::string angles_note(const SimulationOutcome& o) const {
    const bool is_lost = o.cause == Cause::diverged || o.cause == Cause::energy_blowup ||
                         o.cause == Cause::constraint_drift || o.cause == Cause::step_too_coarse;
    if (!is_lost) return {};
    const std::string text =
        singular_angles_text(lost_angles(m_, o.final_state.q, o.final_state.v));
    return text.empty() ? text : "; " + text;
  }

  const Mechanism& m_;
  std::span<BatchCase> cases_;
  std::vector<LaneEnd> ends_;
  std::vector<std::vector<std::size_t>> samples_;
  std::vector<std::vector<double>> looks_;
  std::vector<std::vector<double>> starts_;
  std::vector<std::vector<double>> finals_;
  std::deque<ContactRecorder> recorders_;
  std::vector<LaneCase> lanes_;
};

// Two packs side by side where there is code for both, or one after the other. A lone case takes
// one lane: the same bits, and faster than a pack of copies.
void run_packs(const Mechanism& m, const SimulationOptions& options, std::span<BatchCase> cases,
               const RunLimits& limits, const SimdLevel& level) {
  const long steps = make_step_grid(options).count;
  const auto width = static_cast<std::size_t>(level.lanes);
  Packed packed(m, cases);
  // False, and nothing has run, where two packs have no code.
  const auto run = [&](std::size_t first, std::size_t count) {
    const int lanes = count == 1 ? 1 : level.lanes;
    PackCode code(m, packed.lanes().subspan(first, count), steps, level, lanes);
    if (count > width && code.get() == nullptr) return false;
    packed.run(options, limits, find_kernel(level.isa, lanes), code.get(), first, count);
    return true;
  };
  if (cases.size() > width && run(0, cases.size())) return;
  for (std::size_t i = 0; i < cases.size(); i += width) run(i, std::min(width, cases.size() - i));
}

}  // namespace

bool energy_balances(const SimulationOutcome& outcome) {
  return outcome.energy_residual_max <= kOpenLedger * outcome.energy_scale + kRoundingOfEnergy;
}

int packs_beside(const SimdLevel& level) {
  const bool has_room =
      level.isa == InstructionSet::avx512 && level.lanes > 1 && why_not_written(level).empty();
  return has_room ? 2 : 1;
}

StepGrid make_step_grid(const SimulationOptions& options) {
  const double ratio = options.end_time / options.step;
  const long count = std::max(1L, static_cast<long>(std::ceil(ratio * (1.0 - 1e-12))));
  return {count, options.end_time / static_cast<double>(count)};
}

Sampling sample_output(const StepGrid& grid, double output_interval) {
  return {0, grid.count, std::max(1L, std::lround(output_interval / grid.h))};
}

SimulationOutcome simulate(const Mechanism& mechanism, const Parameters<double>& parameters,
                           const State<double>& start, const SimulationOptions& options,
                           Observers& observers, const RunLimits& limits, const StepLimit& known) {
  std::vector<BatchCase> one{{&parameters, &start, &observers, {}, known}};
  simulate_batch(mechanism, options, one, limits);
  return std::move(one.front().outcome);
}

void simulate_batch(const Mechanism& mechanism, const SimulationOptions& options,
                    std::vector<BatchCase>& cases, const RunLimits& limits) {
  simulate_batch(mechanism, options, cases, limits, simd_level());
}

void simulate_batch(const Mechanism& mechanism, const SimulationOptions& options,
                    std::vector<BatchCase>& cases, const RunLimits& limits,
                    const SimdLevel& level) {
  const auto most = static_cast<std::size_t>(packs_beside(level) * level.lanes);
  const std::span<BatchCase> all(cases);
  if (all.empty()) return;
  if (options.integrator != Integrator::rk4) {
    return Packed(mechanism, all).run_adaptive(options, limits, level);
  }
  for (std::size_t i = 0; i < all.size(); i += most) {
    run_packs(mechanism, options, all.subspan(i, std::min(most, all.size() - i)), limits, level);
  }
}

}  // namespace linkstudy
