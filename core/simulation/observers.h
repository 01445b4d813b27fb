// What is kept of a run. Observers see the accepted states in step order; none allocates while
// stepping. A sampling stride is a whole number of steps, so nothing is interpolated.
// Sums stand for integrals over time, of second order in the stride d (trapezoidal rule):
//   integral_a^b x dt = d sum_i w_i x_i,  w = 1 inside, 1/2 at the first and the last sample
// and where a window [a, b] has more than its samples, the first counts for what lies before it and
// the last for what lies after it (parts of d): w_0 = 1/2 + before, w_n = 1/2 + after.
#pragma once

#include <cstdint>
#include <limits>

#include "core/simulation/channels.h"
#include "core/simulation/contact_record.h"

namespace linkstudy {

// Steps begin, begin + stride, ... <= end.
struct Sampling {
  long begin = 0;
  long end = 0;
  long stride = 1;
  bool hits(long step) const {
    return step >= begin && step <= end && (stride == 1 || (step - begin) % stride == 0);
  }
  long count() const { return end < begin ? 0 : (end - begin) / stride + 1; }
  long last() const { return begin + (count() - 1) * stride; }
};

// What a window has beyond its first and last sample, in strides: 0 <= before, after < 1.
struct WindowEnds {
  double before = 0.0;
  double after = 0.0;
};

// w of a sampled step. A window without length is its one sample. Inlined always: step loops of
// different instruction sets share no function.
[[gnu::always_inline]] inline double time_weight(const Sampling& sampling, const WindowEnds& ends,
                                                 long step) {
  const bool is_first = step == sampling.begin;
  const bool is_last = step > sampling.end - sampling.stride;
  if (is_first && is_last && ends.before + ends.after == 0.0) return 1.0;
  return (is_first ? ends.before : 0.5) + (is_last ? ends.after : 0.5);
}

// Sum of all w: the length of the window in strides, what a mean over time is divided by.
inline double total_weight(const Sampling& sampling, const WindowEnds& ends) {
  const double length = static_cast<double>(sampling.count() - 1) + ends.before + ends.after;
  return length > 0.0 ? length : 1.0;
}

// Values of channels at the sampled steps.
struct Series {
  std::vector<Channel> channels;
  Sampling sampling;
  std::vector<double> values;  // (samples, channels)
  std::size_t rows() const { return channels.empty() ? 0 : values.size() / channels.size(); }
};

// Error of channels against a reference on the same instants, per component and for the vector.
// Only sampled steps count; sums run in step order and are weighted as above.
struct Comparison {
  std::vector<Channel> channels;
  Sampling sampling;
  const double* reference = nullptr;  // (samples, channels), or one row for all samples:
  bool is_constant = false;
  std::vector<double> sign;  // (channels) factor of the reference, +1 or -1
  long seen = 0;
  std::vector<double> max_error;     // (channels)
  std::vector<double> square_error;  // (channels) weighted sum
  double max_vector_error = 0.0;
};

// Extremes and moments of one channel over a window, and where its extremes are first reached:
// steps, and values of another channel there.
struct ChannelReduction {
  Channel channel;
  Sampling sampling;
  WindowEnds ends;
  long seen = 0;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  double sum = 0.0;     // weighted
  double square = 0.0;  // weighted
  double last = 0.0;
  std::vector<Channel> place = {};  // that other channel, or none
  long min_step = 0, max_step = 0;
  double min_place = 0.0, max_place = 0.0;
};

struct Observers {
  std::vector<Series> series;
  std::vector<Comparison> comparisons;
  std::vector<ChannelReduction> reductions;
  ContactList contacts;
};

}  // namespace linkstudy
