// What was measured in one experiment, as residuals take it: for each channel the instants inside
// the window that have a value, and what a residual is divided by:
//   r = (simulated(t + time offset) - measured(t)) / sigma
// Simulated values between two steps are taken from the straight line between them; where an
// instant is a step (to 1e-9 of a step) they are those of the step. Units SI.
#pragma once

#include <memory>

#include "core/simulation/channels.h"
#include "core/simulation/observers.h"
#include "core/simulation/simulate.h"
#include "study/config/study_input.h"

namespace linkstudy {

struct MeasuredSignal {
  std::string channel;
  std::string unit;
  double sigma = 1.0;
  bool has_sigma = false;
  std::vector<double> times, values;
  Location at{};
};

struct MeasuredSet {
  std::vector<MeasuredSignal> signals;
  double offset = 0.0;  // s
  std::size_t sample_count() const;
  double first() const;  // instant
  double last() const;
};

// `channels` are those of the model of the experiment. Problems (channels that are none or several,
// units of another dimension, windows without a sample) are reported at their places.
MeasuredSet make_measured_set(const MeasuredInput& input, const MeasuredData& data,
                              const std::vector<Channel>& channels, Diagnostics& diagnostics);

// Whether the unit of a column, where it has one, is of the channel's kind; reported if not.
bool fits_unit(const MeasuredChannel& measured, const Channel& channel, Diagnostics& diagnostics);

// The histories of a reference run at its output instants, as if measured; without a window all but
// its start, where an unloaded spring never matches.
MeasuredData to_measured_data(const MeasuredInput& input, const std::vector<Trace>& traces);

// Whether a run reaches all instants; where the offset is fitted, whether there is room for it.
void check_instants(const MeasuredInput& input, const MeasuredSet& set, double end_time,
                    Diagnostics& diagnostics);

// Bounds of a fitted offset: a tenth of the duration of the data, as far as the run reaches, s.
struct OffsetRange {
  double low = 0.0;
  double high = 0.0;
};
OffsetRange offset_range(const MeasuredSet& set, double end_time);

// Channels without a sigma are weighed alike: that takes one unit for all of them.
void require_one_unit(const std::vector<const MeasuredSet*>& sets, Diagnostics& diagnostics);

// The samples of one run at the instants of a set.
class InstantSampler {
 public:
  // Throws InvalidPoint where the run does not reach an instant. `is_dense`: keep every step, so
  // that runs with other offsets have observers of one form.
  InstantSampler(const MeasuredSet& set, double offset, const StepGrid& grid, bool is_dense);

  const Sampling& sampling() const { return sampling_; }
  // `series` has a channel for each signal.
  std::vector<double> residuals(const MeasuredSet& set, const Series& series) const;
  // At the instants, signal by signal.
  std::vector<double> simulated(const MeasuredSet& set, const Series& series) const;

 private:
  struct Place {
    long step = 0;
    double part = 0.0;  // of the way to the next step
  };
  std::vector<std::vector<Place>> places_;  // by signal
  Sampling sampling_;
};

}  // namespace linkstudy
