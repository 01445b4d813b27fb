#include "core/simulation/located_batch.h"

#include <algorithm>
#include <bit>
#include <deque>

#include "core/base/flush_denormals.h"

namespace linkstudy {
namespace {

constexpr long kInstantsPerTrial = 7;  // by evaluations

class LocatedBatch {
 public:
  LocatedBatch(const Mechanism& m, const SimulationOptions& options,
               std::span<const LaneCase> cases, const SimdLevel& level,
               const std::function<KernelRun(std::size_t)>& start)
      : m_(m),
        options_(options),
        cases_(cases),
        start_(start),
        // A lone case takes one lane.
        frame_(m, cases, level, cases.size() == 1 ? 1 : level.lanes),
        lanes_(static_cast<std::size_t>(frame_.lanes())),
        reports_(cases.size()) {}

  std::vector<LocatedReport> run() {
    for (int i = 0; i < frame_.lanes(); ++i) fill(i);
    while (active_ != 0) {
      const unsigned asked = lanes_that_want_instants();
      if (is_worth_a_look(asked)) {
        frame_.look_inside(asked);
        take(asked, &LocatedRun::take_instant);
      } else {
        frame_.try_steps(active_);
        take(active_ & ~asked, &LocatedRun::take_trial);
      }
    }
    return std::move(reports_);
  }

 private:
  struct Lane {
    std::optional<LocatedRun> run;
    std::size_t number = 0;  // of its case
  };

  LocatedRun& run_in(int lane) { return *lanes_[static_cast<std::size_t>(lane)].run; }

  template <class F>
  void for_lanes(unsigned some, F&& f) {
    for (int i = 0; some != 0; ++i, some >>= 1)
      if ((some & 1u) != 0) f(i);
  }

  void take(unsigned some, void (LocatedRun::*take_result)()) {
    for_lanes(some, [&](int i) {
      (run_in(i).*take_result)();
      if (run_in(i).has_ended()) fill(i);
    });
  }

  unsigned lanes_that_want_instants() {
    unsigned asked = 0;
    for_lanes(active_, [&](int i) {
      if (run_in(i).wants() == LocatedRun::Wants::instant) asked |= 1u << i;
    });
    return asked;
  }

  // Most lanes want an instant, or those who do can soon go on, at less than what a trial without
  // them would waste.
  bool is_worth_a_look(unsigned asked) {
    if (asked == 0) return false;
    const int all = std::popcount(active_), some = std::popcount(asked);
    if (2 * some >= all) return true;
    long most = 0;
    for_lanes(asked, [&](int i) { most = std::max(most, run_in(i).instants_left()); });
    return most * (all - some) <= kInstantsPerTrial * some;
  }

  // Ends the run in a lane, and begins the next that asks for a trial.
  void fill(int i) {
    Lane& lane = lanes_[static_cast<std::size_t>(i)];
    do {
      if (lane.run) reports_[lane.number] = lane.run->finish();
      lane.run.reset();
      active_ &= ~(1u << i);
      if (next_ == cases_.size()) return;
      lane.number = next_++;
      lane.run.emplace(m_, options_, start_(lane.number), cases_[lane.number], &frame_, i);
      active_ |= 1u << i;
      lane.run->start();
    } while (lane.run->has_ended());
  }

  const Mechanism& m_;
  const SimulationOptions& options_;
  std::span<const LaneCase> cases_;
  const std::function<KernelRun(std::size_t)>& start_;
  TrialFrame frame_;
  std::deque<Lane> lanes_;  // a run does not move
  unsigned active_ = 0;     // lanes with a run, one bit each
  std::size_t next_ = 0;    // case
  std::vector<LocatedReport> reports_;
};

}  // namespace

std::vector<LocatedReport> run_located(const Mechanism& m, const SimulationOptions& options,
                                       std::span<const LaneCase> cases, const SimdLevel& level,
                                       const std::function<KernelRun(std::size_t)>& start) {
  const FlushDenormals flush;
  if (options.integrator == Integrator::adaptive) {
    return LocatedBatch(m, options, cases, level, start).run();
  }
  std::vector<LocatedReport> reports;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    LocatedRun run(m, options, start(i), cases[i]);
    run.run();
    reports.push_back(run.finish());
  }
  return reports;
}

}  // namespace linkstudy
