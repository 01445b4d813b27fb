// Parameters of several cases of one structure, side by side in lanes. Lanes without a case repeat
// the last one.
#pragma once

#include "core/model/parameter_numbers.h"
#include "core/simulation/kernel.h"

namespace linkstudy {

// Those of lane i, which the lists of `packed` have room for.
template <class Real>
inline void set_lane_parameters(Parameters<Real>& packed, int i, const Parameters<double>& p) {
  const auto copy = [i](Real* to, const double* from, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) set_lane(to[k], i, from[k]);
  };
  copy(&packed.gravity.x, &p.gravity.x, 3);
  for_parameter_lists(
      [&](auto& to, const auto& from) {
        copy(numbers_in<Real>(to), numbers_in<double>(from), number_count<double>(from));
      },
      packed, p);
}

template <class Real>
inline Parameters<Real> pack_parameters(const LaneCase* cases, int count) {
  Parameters<Real> packed;
  for_parameter_lists([](auto& to, const auto& from) { to.resize(from.size()); }, packed,
                      *cases[0].parameters);
  for (int i = 0; i < RealTraits<Real>::lanes; ++i) {
    set_lane_parameters(packed, i, *cases[i < count ? i : count - 1].parameters);
  }
  return packed;
}

}  // namespace linkstudy
