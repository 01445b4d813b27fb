// How a calibration goes; the keys of [fit] fill it.
#pragma once

#include <cstdint>

#include "core/base/words.h"

namespace linkstudy {

enum class Autocorrelation { measured, none };

template <>
inline constexpr auto kWords<Autocorrelation> = make_words<Autocorrelation>(
    {{Autocorrelation::measured, "measured", "as the residuals have it"},
     {Autocorrelation::none, "none", "every sample counts in full"}});

struct FitOptions {
  int starts = 20;              // points of a Sobol sequence that fits begin at
  int max_evaluations = 20000;  // budget
  double difference = 1.0e-3;   // relative length of central differences
  Autocorrelation autocorrelation = Autocorrelation::measured;
  double confidence = 0.95;  // of the intervals
  bool profiles = true;      // intervals from profiles; false: linearised ones only
  std::uint64_t seed = 1;    // shifts the Sobol sequence
};

}  // namespace linkstudy
