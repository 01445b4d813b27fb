// Elementary effects, Morris (Technometrics 33, 1991). From one point of a trajectory to the next
// parameter i alone moves, by d in its unit interval:
//   EE_i = (y(x + d e_i) - y(x)) / d
// in the unit of y, for the whole range of the parameter where effects were constant. Over the
// trajectories: mu their mean; mu* the mean of |EE_i| (Campolongo, Cariboni and Saltelli, Environ.
// Model. Softw. 22, 2007), which effects of changing sign do not cancel; sigma their standard
// deviation, large where the effect is curved or depends on other parameters.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace linkstudy::sensitivity {

// One effect for each parameter from the k + 1 points of a trajectory and the values there.
std::vector<double> elementary_effects(std::span<const std::vector<double>> points,
                                       std::span<const double> values);

struct EffectMeasures {
  double mu = 0.0;
  double mu_star = 0.0;
  double sigma = 0.0;  // 0 of a single effect
};

// `rows`: which of the effects, some more than once in a resample.
EffectMeasures measure_effects(std::span<const double> effects, std::span<const std::size_t> rows);

}  // namespace linkstudy::sensitivity
