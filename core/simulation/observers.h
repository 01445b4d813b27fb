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

template <class Real>
inline void observe(Series<Real>& s, long step, Instant<Real>& now) {
  if (!s.sampling.hits(step)) return;
  for (const Channel& c : s.channels) s.values.push_back(now.sample(c));
}

template <class Real>
inline void observe(Comparison<Real>& s, long step, Instant<Real>& now) {
  if (!s.sampling.hits(step)) return;
  const std::size_t n = s.channels.size();
  const double* reference = s.reference + static_cast<std::size_t>(s.seen) * n;
  Real vector_square(0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const Real error = now.sample(s.channels[i]) - Real(s.sign[i] * reference[i]);
    s.max_error[i] = max(s.max_error[i], abs(error));
    s.square_error[i] = madd(error, error, s.square_error[i]);
    vector_square = madd(error, error, vector_square);
  }
  s.max_vector_error = max(s.max_vector_error, sqrt(vector_square));
  s.square_vector_error = s.square_vector_error + vector_square;
  ++s.seen;
}

template <class Real>
inline void observe(ChannelReduction<Real>& s, long step, Instant<Real>& now) {
  if (!s.sampling.hits(step)) return;
  const Real x = now.sample(s.channel);
  s.min = min(s.min, x);
  s.max = max(s.max, x);
  s.sum = s.sum + x;
  s.square = madd(x, x, s.square);
  s.last = x;
  ++s.seen;
}

template <class Real>
inline void observe(Observers<Real>& all, long step, Instant<Real>& now) {
  for (auto& s : all.comparisons) observe(s, step, now);
  for (auto& s : all.reductions) observe(s, step, now);
  for (auto& s : all.series) observe(s, step, now);
}

// Space for everything a run will append.
template <class Real>
inline void reserve(Observers<Real>& all) {
  for (auto& s : all.series) {
    s.values.reserve(static_cast<std::size_t>(s.sampling.count()) * s.channels.size());
  }
  for (auto& s : all.comparisons) {
    s.max_error.assign(s.channels.size(), Real(0.0));
    s.square_error.assign(s.channels.size(), Real(0.0));
  }
}

}  // namespace linkstudy
