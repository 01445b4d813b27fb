// What a sampled parameter follows, by its quantile function x(u), 0 < u < 1:
//   lin         x = low + (high - low) u
//   log         x = low (high / low)^u, uniform in log x
//   normal      F(x) = F(low) + u (F(high) - F(low)), F that of N(mean, deviation^2): truncated
//               where it has bounds, else low = -inf, high = inf
//   triangular  rises from low to its mode and falls to high
// lin and log are defined at 0 and 1 too and give their ends there to the bit. Units are those of
// the parameter.
#pragma once

#include <limits>

namespace linkstudy {

enum class Law { lin, log, normal, triangular };

struct Distribution {
  Law law = Law::lin;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double mean = 0.0;       // of normal
  double deviation = 1.0;  // of normal
  double mode = 0.0;       // of triangular

  bool operator==(const Distribution&) const = default;
};

// The least u of a sample; the greatest is 1 less this (random_stream.h).
inline constexpr double kLeastUnit = 0x1p-53;

double quantile(const Distribution& distribution, double u);

// What the bounds leave of a normal distribution, 0 .. 1.
double share_within_bounds(const Distribution& normal);

}  // namespace linkstudy
