// Relative error of a signal against measured samples: the definitions of match_error.h, over the
// instants inside the window at which a component was measured, missing samples left out. The
// simulated value of an instant between two steps is that of the straight line between them
// (measured_set.h). Means over time are trapezoidal over the component's own instants t_i:
//   w_i = (t_(i+1) - t_(i-1)) / 2,  half an interval at the first and the last;  mean = sum w f /
//   sum w
// With scale = "vector": |r| at an instant is taken from the components measured there, and its
// mean square is the sum of those of the components. Units SI.
#pragma once

#include "study/metrics/match_error.h"
#include "study/metrics/measured_set.h"
#include "study/metrics/study_signals.h"
#include "study/record/evaluation.h"

namespace linkstudy {

// What the matches of a load case are compared with. Instants are those of the run's clock, signs
// are turned where the match asks for it.
struct MeasuredReference {
  std::vector<MeasuredSet> match;   // by [[match]], a signal for each component
  std::vector<ErrorScales> scales;  // likewise
  // As measured, time first: every instant that some match compares; NaN where nothing was.
  std::vector<Trace> traces;
};

// `signals`: those of the model of the case. Reported at their places: components that were not
// measured, columns that no match compares, other dimensions, windows without a sample; what is
// returned then is not to be used.
MeasuredReference make_measured_reference(const StudyInput& input, const MeasuredInput& measured,
                                          const StudySignals& signals, Diagnostics& diagnostics);

class MeasuredMatch {
 public:
  // Of the match at this position. `reference` must outlive this. Throws InvalidPoint where the run
  // does not reach an instant.
  MeasuredMatch(const MeasuredReference& reference, std::size_t match, const StepGrid& grid);

  // Steps at which the signal is needed.
  const Sampling& sampling() const { return sampler_.sampling(); }

  // error_max of every component, then error_rms of every component. `series` has a channel for
  // each component.
  std::vector<double> reduce(const Series& series) const;

 private:
  const MeasuredSet& set_;
  const ErrorScales& scales_;
  InstantSampler sampler_;
};

}  // namespace linkstudy
