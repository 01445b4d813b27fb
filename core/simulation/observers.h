// What is kept of a run. Observers see the accepted states in step order; none allocates while
// stepping. A sampling stride is a whole number of steps, so nothing is interpolated.
#pragma once

#include <cstdint>
#include <limits>

#include "core/simulation/channels.h"

namespace linkstudy {

// Steps begin, begin + stride, ... <= end.
struct Sampling {
  long begin = 0;
  long end = 0;
  long stride = 1;
  bool hits(long step) const {
    return step >= begin && step <= end && (step - begin) % stride == 0;
  }
  long count() const { return end < begin ? 0 : (end - begin) / stride + 1; }
};

// Values of channels at the sampled steps.
template <class Real>
struct Series {
  std::vector<Channel> channels;
  Sampling sampling;
  std::vector<Real> values;  // (samples, channels)
  std::size_t rows() const { return channels.empty() ? 0 : values.size() / channels.size(); }
};

// Error of channels against a reference on the same instants, per component and for the vector.
// Only sampled steps count; sums run in step order.
template <class Real>
struct Comparison {
  std::vector<Channel> channels;
  Sampling sampling;
  const double* reference = nullptr;  // (samples, channels)
  std::vector<double> sign;           // (channels) factor of the reference, +1 or -1
  long seen = 0;
  std::vector<Real> max_error;     // (channels)
  std::vector<Real> square_error;  // (channels) sum
  Real max_vector_error = Real(0.0);
  Real square_vector_error = Real(0.0);
};

// Extremes and moments of one channel over a window.
template <class Real>
struct ChannelReduction {
  Channel channel;
  Sampling sampling;
  long seen = 0;
  Real min = Real(std::numeric_limits<double>::infinity());
  Real max = Real(-std::numeric_limits<double>::infinity());
  Real sum = Real(0.0);
  Real square = Real(0.0);
  Real last = Real(0.0);
};

template <class Real>
struct Observers {
  std::vector<Series<Real>> series;
  std::vector<Comparison<Real>> comparisons;
  std::vector<ChannelReduction<Real>> reductions;
};

}  // namespace linkstudy
