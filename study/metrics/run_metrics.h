// The observers of one run and the numbers it is reduced to.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "study/metrics/match_error.h"
#include "study/metrics/measured_match.h"
#include "study/metrics/response_list.h"
#include "study/metrics/response_watch.h"

namespace linkstudy {

// What was measured in the run, and when that was, on its clock.
struct MeasuredRun {
  std::shared_ptr<const MeasuredSet> set;                   // or null
  double offset = 0.0;                                      // s
  bool varies = false;                                      // the offset does from run to run
  std::shared_ptr<const MeasuredReference> reference = {};  // of [[match]], or null
};

class RunMetrics {
 public:
  // `reference` may be null when nothing is matched, or with measured data. What a run is compared
  // with is taken from `like` where that has the same: it is megabytes. Throws InvalidPoint.
  RunMetrics(const StudyInput& input, const StudySignals& signals, const SimulationOptions& options,
             const ReferenceRecord* reference, const RunMetrics* like = nullptr,
             const MeasuredRun& measured = {});

  Observers& observers() { return observers_; }
  const Observers& observers() const { return observers_; }

  // The outcome, failed where the run has not the turns that are looked at.
  SimulationOutcome judged(const SimulationOutcome& outcome) const;

  // One number for each response of a load case (response_list.h). Of a run that failed only what
  // does not depend on its end is kept, the rest is NaN.
  std::vector<double> reduce(const SimulationOutcome& outcome) const;

  // Against what was measured; empty where nothing was, or the run failed.
  std::vector<double> residuals(const SimulationOutcome& outcome) const;

  // Histories asked for, time first; empty when there are none.
  std::vector<Trace> traces() const;
  // Contacts of a run whose histories are kept; nothing where it has none.
  std::optional<Table> contacts(const Mechanism& mechanism) const;

 private:
  // What a run is compared with, all of it constant.
  struct Compared {
    StepGrid grid;
    const ReferenceRecord* reference;
    std::shared_ptr<const MeasuredReference> measured;
    std::vector<std::vector<Channel>> channels;  // by match
    std::deque<MatchError> matches;              // with a run
    std::deque<MeasuredMatch> measured_matches;  // with data
  };

  static std::shared_ptr<const Compared> compare(const StudyInput& input,
                                                 const StudySignals& signals, const StepGrid& grid,
                                                 const ReferenceRecord* reference,
                                                 const MeasuredRun& measured);
  bool compares_alike(const StudySignals& signals, const StepGrid& grid,
                      const ReferenceRecord* reference, const MeasuredRun& measured) const;
  void add_gaps(const StudySignals& signals);
  double find_gap() const;

  StepGrid grid_;
  std::shared_ptr<const Compared> compared_;
  Observers observers_;  // comparisons: matches, then gaps
  std::optional<ResponseWatch> responses_;
  bool has_traces_ = false;
  std::size_t first_match_ = 0;  // series of the first match with data; the others follow
  std::shared_ptr<const MeasuredSet> measured_;
  std::optional<InstantSampler> sampler_;  // its series is the last
};

// Histories of `channels` at every output interval, time first.
Series make_histories(const std::vector<Channel>& channels, const StepGrid& grid,
                      double output_interval);

// A series as histories; `channels` start with time.
std::vector<Trace> to_traces(const Series& series);

// The state at a row, of the times, positions and velocities that the series has; others are those
// of make_state.
State<double> state_at(const Series& series, const Mechanism& mechanism, std::size_t row);

// The channel "time".
Channel time_channel();

}  // namespace linkstudy
