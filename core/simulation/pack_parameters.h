// Parameters of several cases of one structure, side by side in lanes. Lanes without a case repeat
// the last one.
#pragma once

#include <array>
#include <cstring>

#include "core/base/walk.h"
#include "core/simulation/kernel.h"

namespace linkstudy {

// Fills every Real of `to` from the same number of each lane's record.
template <class Real, class To, class From>
inline void pack_record(To& to, const std::array<const From*, RealTraits<Real>::lanes>& from) {
  constexpr std::size_t numbers = sizeof(From) / sizeof(double);
  static_assert(sizeof(To) == numbers * sizeof(Real));
  for (std::size_t k = 0; k < numbers; ++k) {
    Real x(0.0);
    for (int i = 0; i < RealTraits<Real>::lanes; ++i) {
      double number;
      const auto* record = reinterpret_cast<const unsigned char*>(at(from, i));
      std::memcpy(&number, record + k * sizeof(double), sizeof(double));
      set_lane(x, i, number);
    }
    std::memcpy(reinterpret_cast<unsigned char*>(&to) + k * sizeof(Real), &x, sizeof(Real));
  }
}

// The records of all lanes: member(parameters) of each case.
template <class Real, class F>
inline auto lane_records(const LaneCase* cases, int count, F&& member) {
  using Record = std::remove_cvref_t<decltype(member(*cases[0].parameters))>;
  std::array<const Record*, RealTraits<Real>::lanes> from;
  for (int i = 0; i < RealTraits<Real>::lanes; ++i) {
    at(from, i) = &member(*cases[i < count ? i : count - 1].parameters);
  }
  return from;
}

template <class Real>
inline Parameters<Real> pack_parameters(const LaneCase* cases, int count) {
  using Numbers = Parameters<double>;
  Parameters<Real> packed;
  pack_record<Real>(packed.gravity,
                    lane_records<Real>(
                        cases, count, [](const Numbers& p) -> const auto& { return p.gravity; }));
  const auto pack_all = [&](auto& to, auto list) {
    to.resize((cases[0].parameters->*list).size());
    for (std::size_t n = 0; n < to.size(); ++n) {
      pack_record<Real>(
          to[n], lane_records<Real>(
                     cases, count, [=](const Numbers& p) -> const auto& { return (p.*list)[n]; }));
    }
  };
  pack_all(packed.bodies, &Numbers::bodies);
  pack_all(packed.pitch, &Numbers::pitch);
  pack_all(packed.closures, &Numbers::closures);
  pack_all(packed.springs, &Numbers::springs);
  pack_all(packed.loads, &Numbers::loads);
  pack_all(packed.joint_springs, &Numbers::joint_springs);
  pack_all(packed.clearances, &Numbers::clearances);
  pack_all(packed.frictions, &Numbers::frictions);
  pack_all(packed.segments, &Numbers::segments);
  pack_all(packed.points, &Numbers::points);
  return packed;
}

}  // namespace linkstudy
