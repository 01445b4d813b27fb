// Parameters of several cases of one structure, side by side in lanes. Lanes without a case repeat
// the last one.
#pragma once

#include "core/model/parameter_numbers.h"
#include "core/simulation/kernel.h"

namespace linkstudy {

template <class Real>
inline Parameters<Real> pack_parameters(const LaneCase* cases, int count) {
  Parameters<Real> packed;
  const auto copy = [&](int i, Real* to, const double* from, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) set_lane(to[k], i, from[k]);
  };
  for (int i = 0; i < RealTraits<Real>::lanes; ++i) {
    const Parameters<double>& p = *cases[i < count ? i : count - 1].parameters;
    const auto copy_list = [&](auto& to, const auto& from) {
      to.resize(from.size());
      copy(i, numbers_in<Real>(to), numbers_in<double>(from), number_count<double>(from));
    };
    copy(i, &packed.gravity.x, &p.gravity.x, 3);
    for_parameter_lists(copy_list, packed, p);
  }
  return packed;
}

}  // namespace linkstudy
