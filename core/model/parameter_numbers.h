// Parameters as numbers in a row: the one list of what a run reads of them.
#pragma once

#include <cstddef>
#include <type_traits>

#include "core/model/parameters.h"

namespace linkstudy {

// f(list, ...) of the lists of numbers that a run reads, of all the sets of parameters.
template <class F, class... P>
inline void for_parameter_lists(F&& f, P&... p) {
  f(p.bodies...);
  f(p.pitch...);
  f(p.closures...);
  f(p.springs...);
  f(p.loads...);
  f(p.joint_springs...);
  f(p.point_springs...);
  f(p.clearances...);
  f(p.stops...);
  f(p.frictions...);
  f(p.constant_frictions...);
  f(p.segments...);
  f(p.motions...);
  f(p.knots...);
  f(p.coupling_offsets...);
  f(p.coupling_factors...);
  f(p.points...);
}

// The numbers of a list of records, which are made of numbers and nothing else.
template <class Real, class List>
inline auto* numbers_in(List& list) {
  using Record = typename std::remove_cvref_t<List>::value_type;
  static_assert(sizeof(Record) % sizeof(Real) == 0);
  using Number = std::conditional_t<std::is_const_v<List>, const Real, Real>;
  return reinterpret_cast<Number*>(list.data());
}
template <class Real, class List>
inline std::size_t number_count(const List& list) {
  return list.size() * (sizeof(typename List::value_type) / sizeof(Real));
}

// f(numbers, how many) of everything that a run reads, always in the same order.
template <class Real, class P, class F>
inline void for_parameter_numbers(P& p, F&& f) {
  using Number = std::conditional_t<std::is_const_v<P>, const Real, Real>;
  f(reinterpret_cast<Number*>(&p.gravity), sizeof(p.gravity) / sizeof(Real));
  for_parameter_lists([&](auto& list) { f(numbers_in<Real>(list), number_count<Real>(list)); }, p);
}

// How many they are: chosen points count, though they are no structure.
template <class Real>
inline int parameter_number_count(const Parameters<Real>& p) {
  std::size_t count = 0;
  for_parameter_numbers<Real>(p, [&](const Real*, std::size_t n) { count += n; });
  return static_cast<int>(count);
}

}  // namespace linkstudy
