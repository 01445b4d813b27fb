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
struct Series {
  std::vector<Channel> channels;
  Sampling sampling;
  std::vector<double> values;  // (samples, channels)
  std::size_t rows() const { return channels.empty() ? 0 : values.size() / channels.size(); }
};

// Error of channels against a reference on the same instants, per component and for the vector.
// Only sampled steps count; sums run in step order.
struct Comparison {
  std::vector<Channel> channels;
  Sampling sampling;
  const double* reference = nullptr;  // (samples, channels)
  std::vector<double> sign;           // (channels) factor of the reference, +1 or -1
  long seen = 0;
  std::vector<double> max_error;     // (channels)
  std::vector<double> square_error;  // (channels) sum
  double max_vector_error = 0.0;
  double square_vector_error = 0.0;
};

// Extremes and moments of one channel over a window.
struct ChannelReduction {
  Channel channel;
  Sampling sampling;
  long seen = 0;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  double sum = 0.0;
  double square = 0.0;
  double last = 0.0;
};

struct Observers {
  std::vector<Series> series;
  std::vector<Comparison> comparisons;
  std::vector<ChannelReduction> reductions;
};

}  // namespace linkstudy
