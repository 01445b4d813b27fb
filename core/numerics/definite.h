// Linear systems with a symmetric matrix A, (n, n) row by row, lower triangle used, that is
// positive definite by a margin: A = L D L^T without pivoting, L unit lower.
#pragma once

#include "core/base/real.h"
#include "core/base/walk.h"

namespace linkstudy {

// n is an int, or a std::integral_constant where the size is known to the compiler.

// Overwrites the strict lower triangle of A with L; inverse[i] is 1 / D_i. True in the lanes where
// every pivot is more than `margin` times the largest diagonal of A; other lanes hold no factor.
template <class Size, class Real>
inline auto factorize_definite(Size n, Real margin, Real* a, Real* inverse) {
  const Real one(1.0);
  Real largest(0.0);
  for_range(Index<0>(), n, [&](auto j) { largest = max(largest, a[j * n + j]); });
  const Real limit = margin * largest;
  auto definite = one > Real(0.0);
  for_range(Index<0>(), n, [&](auto j) {
    Real pivot = a[j * n + j];
    for_range(Index<0>(), j,
              [&](auto k) { pivot = nmadd(a[j * n + k] * a[j * n + k], a[k * n + k], pivot); });
    const auto clear = pivot > limit;
    definite = definite && clear;
    a[j * n + j] = select(clear, pivot, one);
    inverse[j] = one / a[j * n + j];
    for_range(successor(j), n, [&](auto i) {
      Real x = a[i * n + j];
      for_range(Index<0>(), j,
                [&](auto k) { x = nmadd(a[i * n + k] * a[j * n + k], a[k * n + k], x); });
      a[i * n + j] = x * inverse[j];
    });
  });
  return definite;
}

// b := A^-1 b
template <class Size, class Real>
inline void solve_definite(Size n, const Real* l, const Real* inverse, Real* b) {
  for_range(Index<0>(), n, [&](auto i) {
    for_range(Index<0>(), i, [&](auto k) { b[i] = nmadd(l[i * n + k], b[k], b[i]); });
  });
  for_range_down(Index<0>(), n, [&](auto i) {
    Real x = b[i] * inverse[i];
    for_range(successor(i), n, [&](auto k) { x = nmadd(l[k * n + i], b[k], x); });
    b[i] = x;
  });
}

}  // namespace linkstudy
