// Loops of the step loop over the structure of a linkage. Structure is either known when a program
// runs (indices are int, loops are loops) or when it is compiled (indices are constants, loops are
// written out, and what structure decides costs nothing). The algorithms are written once, over
// these functions; an Index converts to int wherever a number is needed.
#pragma once

#include <array>
#include <type_traits>
#include <utility>
#include <vector>

namespace linkstudy {

template <int N>
using Index = std::integral_constant<int, N>;

template <class T>
concept Constant = requires {
  T::value;
};

// Structure that is part of the type: an empty type with static members.
template <class S>
concept FixedStructure = std::is_empty_v<S>;

// As many as the type tells, or as many as a program finds when it runs.
template <class T, int Count>
using Array = std::conditional_t<(Count < 0), std::vector<T>,
                                 std::array<T, static_cast<std::size_t>(Count < 0 ? 0 : Count)>>;

// a[i]; i may be a constant.
template <class A>
constexpr auto& at(A& a, int i) {
  return a.data()[i];
}

// f(s, i), as a constant where s is fixed; f has no captures.
template <class S, class I, class F>
constexpr auto structural(const S& s, I i, F f) {
  if constexpr (FixedStructure<S>) {
    return Index<F{}(S{}, I{})>();
  } else {
    return f(s, i);
  }
}

// i + 1
template <class I>
constexpr auto successor(I i) {
  if constexpr (Constant<I>) {
    return Index<I::value + 1>();
  } else {
    return i + 1;
  }
}

namespace detail {

template <int Begin, int Step, class F, int... I>
inline void unroll(F& f, std::integer_sequence<int, I...>) {
  (f(Index<Begin + Step * I>()), ...);
}

}  // namespace detail

// f(begin), f(begin + 1), ..., f(end - 1)
template <class B, class E, class F>
inline void for_range(B begin, E end, F&& f) {
  if constexpr (Constant<B> && Constant<E>) {
    constexpr int count = E::value > B::value ? E::value - B::value : 0;
    detail::unroll<B::value, 1>(f, std::make_integer_sequence<int, count>());
  } else {
    for (int i = begin; i < end; ++i) f(i);
  }
}

// f(end - 1), ..., f(begin)
template <class B, class E, class F>
inline void for_range_down(B begin, E end, F&& f) {
  if constexpr (Constant<B> && Constant<E>) {
    constexpr int count = E::value > B::value ? E::value - B::value : 0;
    detail::unroll<E::value - 1, -1>(f, std::make_integer_sequence<int, count>());
  } else {
    for (int i = end - 1; i >= begin; --i) f(i);
  }
}

// f(k), f(parent of k), ... as long as there is one: `tree` has nv and v_parent.
template <class Tree, class I, class F>
inline void for_path(const Tree& tree, I k, F&& f) {
  if constexpr (Constant<I>) {
    if constexpr (I::value >= 0) {
      f(k);
      for_path(tree, Index<Tree::v_parent[static_cast<std::size_t>(I::value)]>(), f);
    }
  } else {
    for (int i = k; i >= 0; i = at(tree.v_parent, i)) f(i);
  }
}

// f of all ancestors of k.
template <class Tree, class I, class F>
inline void for_ancestors(const Tree& tree, I k, F&& f) {
  for_path(tree, structural(tree, k, [](const auto& t, int i) { return at(t.v_parent, i); }), f);
}

// f(0), ..., f(nv - 1), and the other way round.
template <class Tree, class F>
inline void for_velocities(const Tree& tree, F&& f) {
  for_range(Index<0>(), structural(tree, 0, [](const auto& t, int) { return t.nv; }), f);
}

template <class Tree, class F>
inline void for_velocities_down(const Tree& tree, F&& f) {
  for_range_down(Index<0>(), structural(tree, 0, [](const auto& t, int) { return t.nv; }), f);
}

}  // namespace linkstudy
